// SPDX-License-Identifier: BSD-3-Clause
// Finds the operands of an expression and hands what is left to muParser, which knows
// the order of operations. Its own errors would name places of a text that the user has
// not written, so that it gets only what it understands.
#include "common/numbers.h"
#include "common/printable.h"
#include "common/records.h"
#include "common/similar_words.h"
#include "expressions/formula.h"
#include "expressions/label_text.h"
#include "expressions/operand_names.h"
#include "expressions/program.h"
#include "expressions/tokens.h"
#include <pcl_uvol/expressions/derived_fields.h>

#include <algorithm>
#include <charconv>
#include <utility>
#include <vector>

namespace pcl_uvol {

namespace {

/** Norms and derivatives in one another: beyond it the stack would overflow. */
constexpr std::size_t most_depth = 32;

/** muParser takes 20,000 characters, names of variables among them. */
constexpr std::size_t most_characters = 4000;

using Kind = Token::Kind;

class FormulaParser {
public:
  FormulaParser(const Dataset& header, const std::string& text)
      : header_(header)
      , fields_(header.cloud.fields)
      , origin_(header.origin)
      , labels_(header.labels)
      , text_(text)
  {
  }

  Formula
  parseAll()
  {
    if (text_.size() > most_characters)
      fail("expression_too_long",
           most_characters,
           {{"characters", text_.size()}, {"most", most_characters}});
    Formula formula = parse('\0', 0);
    if (!formula.hasField())
      fail("expression_without_field", 0);
    return formula;
  }

private:
  struct Opened {
    std::size_t place;
    bool is_function;
  };

  /** What is known of the formula that is being read. */
  struct Draft {
    std::vector<Token> tokens;
    std::vector<Opened> opened; ///< parentheses
    std::vector<Operand> operands;
  };

  [[noreturn]] void
  fail(std::string code, std::size_t place, std::vector<MessageValue> values = {}) const
  {
    throw ExpressionError(std::move(code), std::move(values), text_, place);
  }

  char
  peek(std::size_t ahead = 0) const
  {
    return at_ + ahead < text_.size() ? text_[at_ + ahead] : '\0';
  }

  void
  skipBlanks()
  {
    while (at_ < text_.size() && (text_[at_] == ' ' || text_[at_] == '\t'))
      ++at_;
  }

  /** The formula up to the end, or to a comma or that closing character.
   * \param opening place of what is closed */
  Formula
  parse(char closing, std::size_t opening)
  {
    if (++depth_ > most_depth)
      fail("expression_too_deep", at_, {{"most", most_depth}});
    Draft draft;
    skipBlanks();
    const std::size_t begin = at_;
    bool needs_operand = true;
    for (;; skipBlanks()) {
      if (needs_operand)
        needs_operand = !readOperand(draft);
      else if (isAtEnd(draft, closing, opening))
        break;
      else
        needs_operand = readOperator(draft, closing);
    }
    --depth_;
    return finish(
        std::move(draft),
        std::string(trimmed(std::string_view(text_).substr(begin, at_ - begin))));
  }

  bool
  isAtEnd(const Draft& draft, char closing, std::size_t opening) const
  {
    if (at_ == text_.size()) {
      if (!draft.opened.empty())
        fail("parenthesis_not_closed", draft.opened.back().place);
      if (closing != '\0')
        fail(closing == '|' ? "bar_not_closed" : "parenthesis_not_closed", opening);
      return true;
    }
    return closing != '\0' && draft.opened.empty() &&
           (peek() == closing || peek() == ',');
  }

  void
  add(Draft& draft, Kind kind, std::size_t characters, const std::string& program)
  {
    draft.tokens.push_back({kind, at_, program});
    at_ += characters;
  }

  /** \return false where another one must follow: after a sign, say */
  bool
  readOperand(Draft& draft)
  {
    const char c = peek();
    if (c == '(') {
      draft.opened.push_back({at_,
                              !draft.tokens.empty() &&
                                  draft.tokens.back().kind == Kind::Other &&
                                  findNameEnd(draft.tokens.back().program, 0) > 0});
      add(draft, Kind::Open, 1, "(");
      return false;
    }
    if (c == '+' || c == '-' || c == '!') {
      add(draft, Kind::Sign, 1, std::string(1, c));
      return false;
    }
    if (const std::size_t size = findFieldName(fields_, text_, at_); size > 0) {
      const std::size_t end = findNameEnd(text_, at_);
      if (!(end - at_ >= size && isCallAt(end))) {
        addField(draft, text_.substr(at_, size), size);
        return true;
      }
    }
    if (c == '|') {
      readNorm(draft);
      return true;
    }
    if (c == '"') {
      readQuotedName(draft);
      return true;
    }
    if (const std::size_t end = findNumberEnd(text_, at_); end > at_) {
      readNumber(draft, end);
      return true;
    }
    return readName(draft);
  }

  bool
  isCallAt(std::size_t end) const
  {
    while (end < text_.size() && text_[end] == ' ')
      ++end;
    return end < text_.size() && text_[end] == '(';
  }

  void
  readNumber(Draft& draft, std::size_t end)
  {
    const std::string digits = text_.substr(at_, end - at_);
    double number = 0.0;
    if (!parseNumber(digits, number))
      fail("number_too_large", at_);
    add(draft, Kind::Number, digits.size(), digits);
    draft.tokens.back().number = number;
  }

  bool
  readName(Draft& draft)
  {
    const std::size_t end = findNameEnd(text_, at_);
    if (end == at_)
      fail(at_ == text_.size() ? "operand_missing_at_end" : "operand_missing", at_);
    const std::string name = text_.substr(at_, end - at_);
    if (isCallAt(end))
      return readCall(draft, name);
    if (name == "pi" || name == "inf")
      add(draft, Kind::Other, name.size(), name);
    else
      addField(draft, name, name.size());
    return true;
  }

  /** \return true for a derivative, which is an operand; the arguments of other
   * functions follow */
  bool
  readCall(Draft& draft, const std::string& name)
  {
    const auto derivative = findDerivative(name);
    if (!derivative) {
      const auto& functions = listFunctions();
      if (std::find(functions.begin(), functions.end(), name) == functions.end())
        fail("unknown_function", at_, valuesOfUnknownFunction(name));
      add(draft, Kind::Other, name.size(), name);
      return false;
    }
    const std::size_t begin = at_;
    at_ = text_.find('(', at_);
    Operand operand;
    operand.kind = Operand::Kind::Derivative;
    operand.derivative = *derivative;
    operand.arguments = readArguments(')');
    checkArguments(operand, name, begin);
    addOperand(draft, std::move(operand), begin);
    return true;
  }

  /** From the opening character to behind the closing one. */
  std::vector<Formula>
  readArguments(char closing)
  {
    const std::size_t opening = at_++;
    std::vector<Formula> arguments;
    for (;; ++at_) {
      arguments.push_back(parse(closing, opening));
      if (peek() == closing)
        break;
    }
    ++at_;
    return arguments;
  }

  void
  checkArguments(const Operand& operand,
                 const std::string& name,
                 std::size_t place) const
  {
    const auto& arguments = operand.arguments;
    if (std::none_of(arguments.begin(), arguments.end(), [](const Formula& argument) {
          return argument.hasField();
        }))
      fail("no_field_derived", place);
    if (operand.derivative == Derivative::Gradient ||
        operand.derivative == Derivative::Laplacian ||
        operand.derivative == Derivative::Curvature) {
      if (arguments.size() != 1 || arguments[0].width() != 1)
        fail("argument_not_one_number", place, {{"function", name}});
      return;
    }
    const bool is_vector = arguments.size() == 1 && arguments[0].width() == 3;
    const bool are_components =
        arguments.size() == 3 &&
        std::all_of(arguments.begin(), arguments.end(), [](const Formula& argument) {
          return argument.width() == 1;
        });
    if (!is_vector && !are_components)
      fail("argument_not_vector", place, {{"function", name}});
  }

  void
  readNorm(Draft& draft)
  {
    const std::size_t begin = at_;
    Operand operand;
    operand.kind = Operand::Kind::Norm;
    operand.arguments = readArguments('|');
    addOperand(draft, std::move(operand), begin);
  }

  void
  readQuotedName(Draft& draft)
  {
    const std::size_t end = text_.find('"', at_ + 1);
    if (end == std::string::npos)
      fail("quotation_not_closed", at_);
    addField(draft, text_.substr(at_ + 1, end - at_ - 1), end + 1 - at_);
  }

  void
  addField(Draft& draft, const std::string& name, std::size_t characters)
  {
    Operand operand = makeFieldOperand(fields_, origin_, name);
    if (operand.components.empty())
      fail("unknown_operand", at_, valuesOfUnknown(header_, name));
    const std::size_t begin = at_;
    at_ += characters;
    addOperand(draft, std::move(operand), begin);
    if (const auto* const labels = findLabels(fields_, labels_, name))
      readLabel(draft, name, *labels);
  }

  /** The comparison of a field of names with one of them. */
  void
  readLabel(Draft& draft,
            const std::string& field,
            const std::vector<std::string>& labels)
  {
    skipBlanks();
    if (peek() != '=' && !(peek() == '!' && peek(1) == '='))
      fail("names_not_compared",
           at_,
           {{"field", shortenText(field)},
            {"operand", field},
            {"name", shortenText(labels.empty() ? "A-1" : labels.front())}});
    readOperator(draft, '\0');
    skipBlanks();
    std::string name;
    const std::size_t begin = at_;
    const bool is_quoted = isLabelQuote(peek());
    if (!takeLabel(text_, at_, name))
      fail("quotation_not_closed", begin);
    if (name.empty() && !is_quoted)
      fail("name_missing", begin);
    const auto found = std::find(labels.begin(), labels.end(), name);
    if (found == labels.end() && !name.empty()) {
      const std::string similar = findSimilar(labels, name);
      fail("unknown_name",
           begin,
           {{"field", shortenText(field)},
            {"name", shortenText(name)},
            {"has_similar", !similar.empty()},
            {"similar", shortenText(similar)}});
    }
    const std::string label =
        name.empty() ? "-1" : std::to_string(found - labels.begin());
    draft.tokens.push_back({Kind::Number, begin, label, 0, std::stod(label)});
  }

  /** With the component that is chosen behind it. */
  void
  addOperand(Draft& draft, Operand&& operand, std::size_t begin)
  {
    const std::size_t end = at_;
    skipBlanks();
    if (peek() == '[')
      readComponent(operand);
    else
      at_ = end;
    operand.text = text_.substr(begin, at_ - begin);
    const auto known =
        std::find_if(draft.operands.begin(),
                     draft.operands.end(),
                     [&](const Operand& other) { return other.text == operand.text; });
    const auto index = static_cast<std::size_t>(known - draft.operands.begin());
    draft.tokens.push_back({Kind::Operand, begin, "v" + std::to_string(index), index});
    if (known == draft.operands.end())
      draft.operands.push_back(std::move(operand));
  }

  void
  readComponent(Operand& operand)
  {
    const std::size_t opening = at_++;
    std::size_t component = 0;
    const auto parsed =
        std::from_chars(&text_[at_], text_.data() + text_.size(), component);
    const auto end = static_cast<std::size_t>(parsed.ptr - text_.data());
    if (parsed.ec != std::errc() || end == text_.size() || text_[end] != ']')
      fail("component_not_in_brackets", opening);
    if (component >= operand.fullWidth())
      fail("operand_component_too_large", at_, {{"last", operand.fullWidth() - 1}});
    operand.component = component;
    at_ = end + 1;
  }

  /** \return whether an operand must follow */
  bool
  readOperator(Draft& draft, char closing)
  {
    const char c = peek(), next = peek(1);
    switch (c) {
    case ')':
      if (draft.opened.empty())
        fail("no_parenthesis_open", at_);
      draft.opened.pop_back();
      add(draft, Kind::Close, 1, ")");
      return false;
    case ',':
      if (draft.opened.empty() || !draft.opened.back().is_function)
        fail("misplaced_comma", at_);
      add(draft, Kind::Joint, 1, ",");
      return true;
    case '+':
    case '-':
    case '*':
    case '/':
    case '^':
      add(draft, Kind::Other, 1, std::string(1, c));
      return true;
    case '?':
    case ':':
      add(draft, Kind::Joint, 1, std::string(1, c));
      return true;
    case '<':
    case '>':
    case '!':
    case '=':
      if (next == '=')
        add(draft, Kind::Relation, 2, std::string{c, '='});
      else if (c == '!')
        break;
      else
        add(draft, Kind::Relation, 1, c == '=' ? "==" : std::string(1, c));
      return true;
    default:
      if ((c == '&' || (c == '|' && (closing != '|' || !draft.opened.empty()))) &&
          next == c) {
        add(draft, Kind::Joint, 2, std::string(2, c));
        return true;
      }
    }
    fail(c == '&' ? "single_ampersand" : "operator_missing", at_);
  }

  Formula
  finish(Draft&& draft, std::string&& text) const
  {
    Formula formula;
    formula.text = std::move(text);
    formula.operands = std::move(draft.operands);
    if (draft.tokens.size() == 1 && draft.tokens[0].kind == Kind::Operand)
      return formula;
    for (const Token& token : draft.tokens) {
      if (token.kind == Kind::Operand)
        checkScalar(formula.operands[token.operand], token.place);
      formula.compares |= token.kind == Kind::Relation;
    }
    if (const Token* const second = findSecondRelation(draft.tokens))
      fail("chained_comparisons", second->place);
    roundNumbers(formula.operands, draft.tokens);
    std::vector<std::size_t> ends; // of the tokens in the program
    for (const Token& token : draft.tokens) {
      formula.program += token.program;
      ends.push_back(formula.program.size());
    }
    try {
      const Program compiled(formula.program, formula.operands.size());
    }
    catch (const ProgramError& error) {
      const auto token = std::upper_bound(ends.begin(), ends.end() - 1, error.place);
      fail(error.code,
           draft.tokens[static_cast<std::size_t>(token - ends.begin())].place);
    }
    return formula;
  }

  void
  checkScalar(const Operand& operand, std::size_t place) const
  {
    if (operand.width() > 1)
      fail("several_components", place, valuesOfComponents(operand));
  }

  const Dataset& header_;
  const Fields& fields_;
  const std::array<double, 3>& origin_;
  const LabelNames& labels_;
  const std::string& text_;
  std::size_t at_ = 0, depth_ = 0;
};

} // namespace

Formula
parseFormula(const Dataset& header, const std::string& expression)
{
  return FormulaParser(header, expression).parseAll();
}

bool
mayHaveDerivative(const std::string& expression)
{
  for (std::size_t i = 0; i < expression.size(); ++i)
    if (const std::size_t end = findNameEnd(expression, i); end > i) {
      const std::size_t next = expression.find_first_not_of(' ', end);
      if (next != std::string::npos && expression[next] == '(' &&
          findDerivative(expression.substr(i, end - i)))
        return true;
      i = end - 1;
    }
  return false;
}

} // namespace pcl_uvol
