// SPDX-License-Identifier: BSD-3-Clause
// Names in an expression: where they end, and which fields they stand for.
#pragma once

#include "expressions/formula.h"

#include <string_view>

namespace pcl_uvol {

/** Part of an unquoted name, after its first character. */
bool
continuesName(char c);

/** Where the characters of an unquoted name end that begins there. */
std::size_t
findNameEnd(std::string_view text, std::size_t begin);

/** Where the number ends that begins there; the same place if none does. */
std::size_t
findNumberEnd(std::string_view text, std::size_t begin);

/** Bytes of the longest name of a field that stands there, 0 for none. Names with
 * operators in them count only where they stand alone, between parentheses, commas,
 * comparisons or the ends; names that are numbers do not count. */
std::size_t
findFieldName(const std::vector<pcl::PCLPointField>& fields,
              std::string_view text,
              std::size_t begin);

/** The field of that name; coordinates with their origin.
 * \return no components where there is none */
Operand
makeFieldOperand(const std::vector<pcl::PCLPointField>& fields,
                 const std::array<double, 3>& origin,
                 const std::string& name);

/** The name of a field that an expression is in quotation marks, with its component:
 * "\"T, K\"" -> "T, K"; other expressions as they are. */
std::string
withoutQuotes(const std::vector<pcl::PCLPointField>& fields,
              const std::string& expression);

/** The derivative that a function of that name is. */
std::optional<Derivative>
findDerivative(const std::string& name);

/** What a message holds of a name that is no field. */
std::vector<MessageValue>
valuesOfUnknown(const Dataset& header, const std::string& name);

/** What a message holds of a function that is none. */
std::vector<MessageValue>
valuesOfUnknownFunction(const std::string& name);

} // namespace pcl_uvol
