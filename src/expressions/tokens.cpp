// SPDX-License-Identifier: BSD-3-Clause
#include "expressions/tokens.h"

#include "common/numbers.h"

#include <cmath>
#include <cstring>

namespace pcl_uvol {

namespace {

using Kind = Token::Kind;

std::string
writeNumber(double number)
{
  std::uint8_t bytes[sizeof(number)];
  std::memcpy(bytes, &number, sizeof(number));
  std::string text;
  appendNumber(text, pcl::PCLPointField::FLOAT64, bytes);
  return text;
}

/** True where what is compared ends: at conditions, parentheses and the ends. */
bool
isBoundary(const std::vector<Token>& tokens, std::size_t i)
{
  return i >= tokens.size() || tokens[i].kind == Kind::Joint ||
         tokens[i].kind == Kind::Open || tokens[i].kind == Kind::Close;
}

/** \param number place of it among the tokens */
void
roundNumber(const std::vector<Operand>& operands,
            const Token& field,
            std::vector<Token>& tokens,
            std::size_t number,
            bool is_signed)
{
  if (field.kind != Kind::Operand || number >= tokens.size() ||
      tokens[number].kind != Kind::Number)
    return;
  const Operand& operand = operands[field.operand];
  if (operand.kind != Operand::Kind::Field)
    return;
  const std::size_t component = operand.component.value_or(0);
  if (operand.components[component].datatype != pcl::PCLPointField::FLOAT32)
    return;
  const bool is_negative = is_signed && tokens[number - 1].program == "-";
  const double sign = is_negative ? -1.0 : 1.0, addend = operand.addends[component];
  const double rounded =
      static_cast<double>(static_cast<float>(sign * tokens[number].number - addend)) +
      addend;
  if (std::isfinite(rounded))
    tokens[number].program = "(" + writeNumber(sign * rounded) + ")";
}

} // namespace

const Token*
findSecondRelation(const std::vector<Token>& tokens)
{
  std::vector<std::size_t> relations(1);
  for (const Token& token : tokens)
    switch (token.kind) {
    case Kind::Open:
      relations.push_back(0);
      break;
    case Kind::Close:
      relations.pop_back();
      break;
    case Kind::Joint:
      relations.back() = 0;
      break;
    case Kind::Relation:
      if (++relations.back() > 1)
        return &token;
      break;
    default:
      break;
    }
  return nullptr;
}

void
roundNumbers(const std::vector<Operand>& operands, std::vector<Token>& tokens)
{
  for (std::size_t i = 0; i < tokens.size(); ++i) {
    if (tokens[i].kind != Kind::Relation || i == 0)
      continue;
    // T > 4, T > -4
    const bool is_signed = i + 1 < tokens.size() && tokens[i + 1].kind == Kind::Sign;
    if (const std::size_t number = i + 1 + is_signed;
        isBoundary(tokens, i - 2) && isBoundary(tokens, number + 1))
      roundNumber(operands, tokens[i - 1], tokens, number, is_signed);
    // 4 < T, -4 < T
    const bool has_sign = i >= 2 && tokens[i - 2].kind == Kind::Sign;
    if (i + 1 < tokens.size() && isBoundary(tokens, i - 2 - has_sign) &&
        isBoundary(tokens, i + 2))
      roundNumber(operands, tokens[i + 1], tokens, i - 1, has_sign);
  }
}

} // namespace pcl_uvol
