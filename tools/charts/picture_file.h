// SPDX-License-Identifier: BSD-3-Clause
// Pictures as files: of pixels, or with letters over them that stay letters.
#pragma once

#include "charts/drawing.h"
#include <pcl_uvol/io/image_file.h>

#include <optional>
#include <string>
#include <vector>

namespace uvol_tools {

/** \brief Bytes as text, for files of text that hold them. */
std::string
encodeBase64(const void* bytes, std::size_t count);

/** \brief Throw IOError unless the name ends in .png, .svg or .pdf and its folder can
 * be written to: to be called before work whose result would be lost. */
void
checkPicturePath(const std::string& path);

/** \brief The same for a caller that writes .html as well, of which it takes care. */
void
checkDrawingPath(const std::string& path);

/** \brief A picture that is going to be written: as .png, or as .svg or .pdf, in which
 * its letters are text over its pixels, for programs that set and edit figures. */
class PictureFile {
public:
  /** \brief Begin before the picture is drawn: letters of this thread are kept from now
   * on if they stay letters.
   * \param path ends in .png, .svg or .pdf
   * \param dots_per_inch that the file says it is printed with; 0: it says nothing */
  explicit PictureFile(const std::string& path, double dots_per_inch = 0.0);

  /** \brief Write the picture; the file appears whole or not at all.
   * \param texts kept in the file, for those who ask where the picture is from
   * \throws IOError */
  void
  save(const pcl_uvol::Image& picture,
       const std::vector<pcl_uvol::ImageText>& texts = {}) const;

private:
  std::string path_;
  double dots_per_inch_;
  std::optional<TextKeeper> letters_; // that stay letters
};

} // namespace uvol_tools
