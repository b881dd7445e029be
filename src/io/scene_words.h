// SPDX-License-Identifier: BSD-3-Clause
// The words of a scene file, one item per line, and errors that tell their place.
#pragma once

#include "io/files.h"
#include <pcl_uvol/common/exceptions.h>
#include <pcl_uvol/render/color_map.h>

#include <Eigen/Core>

#include <cstddef>
#include <functional>
#include <limits>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace pcl_uvol {
namespace io {

/** \brief Where something stands in a file, from 1. */
struct ScenePlace {
  std::string file;
  std::size_t line = 1, column = 1;

  /** \brief "scene.txt:3:12". */
  std::string
  text() const;
};

/** \throws IOError "scene.txt:3:12: reason" */
[[noreturn]] void
throwAt(const ScenePlace& place, const FileReason& reason);

/** \brief Call a function whose exceptions become IOErrors with that place in front. */
template <typename Function>
auto
callAt(const ScenePlace& place, Function&& function)
{
  try {
    return function();
  }
  catch (const Exception& error) {
    throwAt(place, error.asMessage());
  }
}

/** \brief What a number may be. */
struct NumberRange {
  double low, high;
  bool has_ends;    ///< low and high are numbers of it
  const char* text; ///< "a number ..."
};

constexpr double unbounded = std::numeric_limits<double>::infinity();
constexpr NumberRange any_number{-unbounded, unbounded, false, "a number"};
constexpr NumberRange not_negative{0.0, unbounded, true, "a number of at least 0"};
constexpr NumberRange positive{0.0, unbounded, false, "a number above 0"};
constexpr NumberRange zero_to_one{0.0, 1.0, true, "a number from 0 to 1"};

/** \brief The words of a line, taken one after the other. Every function that takes
 * words throws an IOError that names the place of what is wrong or missing. */
class SceneItem {
public:
  /** \brief An option of an item: its form, such as "fit x y z SIZE", whose first word
   * is its name, and what takes the words that follow the name. */
  struct Option {
    const char* form;
    std::function<void()> take;
  };

  /** \brief Split a line at its blanks; what follows a # is left out, blanks between
   * double quotes belong to the word.
   * \param start of the line */
  SceneItem(const ScenePlace& start, std::string_view line);

  bool
  atEnd() const
  {
    return taken_ == words_.size();
  }

  /** \brief What errors tell to write. */
  void
  setForm(const char* form)
  {
    form_ = form;
  }

  /** \brief The place of the word that was taken last. */
  ScenePlace
  place() const;

  /** \brief Tell what is wrong with the word that was taken last. */
  [[noreturn]] void
  fail(const FileReason& reason) const
  {
    throwAt(place(), reason);
  }

  /** \brief Take a word.
   * \param what it is, for the error if there is none */
  const std::string&
  word(const std::string& what);

  /** \brief Take the next word if it is that one. */
  bool
  takeIf(const char* word);

  double
  number(const NumberRange& range);

  int
  whole(int low, int high);

  Eigen::Vector3d
  point();

  /** \brief A point other than the origin. */
  Eigen::Vector3d
  direction();

  Color
  color();

  /** \brief Take all that follows: options in any order, each once at most.
   * \param exclusive names of two options that do not go together */
  void
  options(const std::vector<Option>& known,
          const std::vector<std::pair<const char*, const char*>>& exclusive = {});

  /** \brief True if options() found one of that name. */
  bool
  hasOption(const std::string& name) const;

  /** \brief Throw if a word is left. */
  void
  finish();

private:
  struct Word {
    std::string text;
    std::size_t column;
  };

  ScenePlace
  placeOf(std::size_t column) const
  {
    return {start_.file, start_.line, column};
  }

  void
  split(std::string_view line);

  ScenePlace start_;
  std::vector<Word> words_;
  std::size_t end_ = 1; ///< column behind the last word
  std::size_t taken_ = 0;
  std::string form_;
  std::vector<std::string> option_names_;
};

/** \brief The first word of a form. */
std::string
cutName(const char* form);

/** \brief Join words by commas. */
std::string
joinWords(const std::vector<std::string>& words);

} // namespace io
} // namespace pcl_uvol
