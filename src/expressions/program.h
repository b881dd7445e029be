// SPDX-License-Identifier: BSD-3-Clause
// The parser that computes the arithmetic of expressions.
#pragma once

#include <cstddef>
#include <memory>
#include <string>
#include <vector>

namespace mu {
class Parser;
}

namespace pcl_uvol {

/** Functions that programs may call, sorted. */
const std::vector<std::string>&
listFunctions();

/** Why a program is none. */
struct ProgramError {
  const char* code;  ///< of the message
  std::size_t place; ///< in the program
};

/** A program with the variables v0, v1, ...; one per thread. */
class Program {
public:
  /** \throws ProgramError */
  Program(const std::string& text, std::size_t variables);
  Program(const Program&) = delete;
  Program&
  operator=(const Program&) = delete;
  ~Program();

  double*
  variables()
  {
    return variables_.data();
  }

  double
  compute();

private:
  std::vector<double> variables_;
  std::unique_ptr<mu::Parser> parser_;
};

} // namespace pcl_uvol
