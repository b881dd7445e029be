// SPDX-License-Identifier: BSD-3-Clause
// A value of JSON. Hides nlohmann's library, whose headers would cost every unit that
// has parameters a second and 100 MB to compile.
#pragma once

#include <pcl_uvol/common/export.h>

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>

namespace pcl_uvol::detail {

/** \brief Copies share their content. A get that does not fit the type throws. */
class PCL_UVOL_EXPORTS JsonValue {
public:
  JsonValue(); ///< null
  explicit JsonValue(bool value);
  explicit JsonValue(double value);
  explicit JsonValue(std::int64_t value);
  explicit JsonValue(std::uint64_t value);
  explicit JsonValue(const std::string& value);

  static JsonValue
  makeObject();
  static JsonValue
  makeList();

  /** \brief Empty for text that is no JSON. */
  static std::optional<JsonValue>
  parse(const std::string& text);

  bool
  isNull() const;
  bool
  isBool() const;
  bool
  isNumber() const;
  bool
  isInteger() const;
  bool
  isUnsigned() const; ///< an integer from 0
  bool
  isString() const;
  bool
  isList() const;
  bool
  isObject() const;

  bool
  getBool() const;
  double
  getNumber() const;
  std::int64_t
  getInteger() const;
  std::uint64_t
  getUnsigned() const;
  std::string
  getString() const;

  /** \brief Entries of a list or an object. */
  std::size_t
  size() const;
  /** \brief Calls visit(key, value) for the entries of an object or a list, whose keys
   * are numbers. */
  void
  forEach(const std::function<void(const std::string&, const JsonValue&)>& visit) const;

  void
  set(const std::string& key, const JsonValue& value);
  void
  append(const JsonValue& value);

  /** \brief As text, with that many blanks per level; in one line without them. */
  std::string
  dump(int indent = -1) const;

private:
  struct Content;
  explicit JsonValue(std::shared_ptr<Content> content);
  std::shared_ptr<Content> content_;
};

} // namespace pcl_uvol::detail
