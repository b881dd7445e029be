// SPDX-License-Identifier: BSD-3-Clause
// What a tool tells besides counts and times: a line for people, a value for programs.
#pragma once

#include <sstream>
#include <string>
#include <utility>
#include <vector>

namespace uvol_tools {

/** \brief The words of a fact. All numbers in them go through this stream: one that is
 * not finite is written as "unknown". */
class FactText : public std::ostringstream {
public:
  FactText();
};

/** \brief A name with a text, and the same as a value of JSON: a text, a number, a list
 * of numbers, or several of them by name. What is no finite number is null in JSON. */
class Fact {
public:
  using Numbers = std::vector<double>;
  using Members = std::vector<std::pair<std::string, Numbers>>;

  /** \param name lower-case words; blanks become underscores in JSON */
  Fact(std::string name, std::string text);
  Fact(std::string name, double number);
  Fact(std::string name, std::string text, double number);
  /** \brief Numbers as a list; the text has commas between them. */
  Fact(std::string name, const Numbers& numbers);
  Fact(std::string name, std::string text, const Numbers& numbers);
  /** \brief Lists of numbers by name, those of one number as that number; none: null.
   */
  Fact(std::string name, std::string text, const Members& members);

  /** \brief Facts by their names, blanks and all, in JSON only: names of fields may
   * differ in a blank. */
  Fact(std::string name, const std::vector<Fact>& facts);

  /** \brief The same fact for people only. */
  Fact
  withoutJson() const;

  const std::string&
  getName() const
  {
    return name_;
  }

  /** \brief Empty for what is in JSON only. */
  const std::string&
  getText() const
  {
    return text_;
  }

  /** \brief The name in JSON; empty for what is for people only. */
  const std::string&
  getKey() const
  {
    return key_;
  }

  /** \brief The value as a text of JSON. */
  const std::string&
  getJson() const
  {
    return json_;
  }

private:
  std::string name_, key_, text_, json_;
};

using Facts = std::vector<Fact>;

inline void
append(Facts& facts, const Facts& more)
{
  facts.insert(facts.end(), more.begin(), more.end());
}

/** \brief The memory of the process so far: the most that a step was expected to need,
 * or the bound that was given, and the peak.
 * \param bound in bytes, 0: none */
Fact
describeMemory(double bound = 0.0);

/** \brief All numbers of a list, as doubles. */
template <typename T>
Fact::Numbers
toNumbers(const T& list)
{
  Fact::Numbers numbers;
  for (const auto& number : list)
    numbers.push_back(static_cast<double>(number));
  return numbers;
}

} // namespace uvol_tools
