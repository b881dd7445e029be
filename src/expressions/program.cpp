// SPDX-License-Identifier: BSD-3-Clause
#include "expressions/program.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <muParser.h>

namespace pcl_uvol {

namespace {

double
negate(double value)
{
  return value == 0.0 ? 1.0 : 0.0;
}

/** A parser that knows everything but the variables. */
std::unique_ptr<mu::Parser>
makeParser()
{
  auto parser = std::make_unique<mu::Parser>();
  // Operations stay in the order in which they are written.
  parser->EnableOptimizer(false);
  parser->DefineConst("pi", 3.141592653589793);
  parser->DefineConst("inf", std::numeric_limits<double>::infinity());
  parser->DefineInfixOprt("!", negate);
  parser->DefineFun("floor", static_cast<double (*)(double)>(std::floor));
  parser->DefineFun("ceil", static_cast<double (*)(double)>(std::ceil));
  return parser;
}

/** The code of the message. */
const char*
explain(const mu::ParserError& error)
{
  switch (error.GetCode()) {
  case mu::ecTOO_MANY_PARAMS:
    return "too_many_arguments";
  case mu::ecTOO_FEW_PARAMS:
    return "too_few_arguments";
  case mu::ecUNEXPECTED_ARG_SEP:
  case mu::ecUNEXPECTED_ARG:
    return "misplaced_comma";
  case mu::ecUNEXPECTED_CONDITIONAL:
  case mu::ecMISSING_ELSE_CLAUSE:
  case mu::ecMISPLACED_COLON:
    return "misplaced_condition";
  case mu::ecEXPRESSION_TOO_LONG:
    return "program_too_long";
  default:
    return "not_computable";
  }
}

} // namespace

const std::vector<std::string>&
listFunctions()
{
  static const std::vector<std::string> names = [] {
    const auto parser = makeParser();
    std::vector<std::string> found;
    for (const auto& function : parser->GetFunDef())
      found.push_back(function.first);
    return found;
  }();
  return names;
}

Program::Program(const std::string& text, std::size_t variables)
    : variables_(variables)
    , parser_(makeParser())
{
  try {
    for (std::size_t i = 0; i < variables; ++i)
      parser_->DefineVar("v" + std::to_string(i), &variables_[i]);
    parser_->SetExpr(text);
    parser_->Eval(); // parses
    if (parser_->GetNumResults() != 1)
      throw ProgramError{"misplaced_comma", std::min(text.find(','), text.size())};
  }
  catch (const mu::ParserError& error) {
    throw ProgramError{explain(error), static_cast<std::size_t>(error.GetPos())};
  }
}

Program::~Program() = default;

double
Program::compute()
{
  return parser_->Eval();
}

} // namespace pcl_uvol
