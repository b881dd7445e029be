// SPDX-License-Identifier: BSD-3-Clause
// What a picture is drawn on, and the size of letters there.
#pragma once

namespace uvol_tools {

/** \brief Pixels of a picture, and how finely they are printed. */
struct Paper {
  int width = 0, height = 0;  ///< 0: as large as is usual for what is drawn
  double dots_per_inch = 0.0; ///< 0: nobody says

  /** \brief Pixels of letters that can be read in print, 7 points, as journals ask for;
   * 0 where nobody says how it is printed. */
  int
  printedLetters() const;

  /** \brief The same, or so small that as many have room along the shorter side. */
  int
  leastLetters(int room) const;

  /** \brief Pixels of letters of a chart, which grow with its size if nobody says how
   * it is printed.
   *
   * \param usual paper of a chart of this kind, with letters of 14 pixels */
  int
  chartLetters(const Paper& usual) const;

  /** \brief This paper, or the usual one where nobody says a size. */
  Paper
  orUsual(const Paper& usual) const
  {
    return width == 0 && height == 0 ? Paper{usual.width, usual.height, dots_per_inch}
                                     : *this;
  }
};

} // namespace uvol_tools
