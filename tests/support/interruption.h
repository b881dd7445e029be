// SPDX-License-Identifier: BSD-3-Clause
// Work that is ended at each of its steps and must leave its object fit for the next
// run.
#pragma once

#include <pcl_uvol/common/stage.h>

#include <gtest/gtest.h>

#include <cstddef>
#include <map>
#include <stdexcept>
#include <string>

namespace uvol_test {

/** \brief What the listener of interruptEveryStep() throws. */
class Interrupted : public std::runtime_error {
public:
  using std::runtime_error::runtime_error;
};

/** \brief Interrupt a run at every step that it tells, at the step's first and last
 * call; the run after each must give what an undisturbed one gives.
 *
 * \param run called as run(progress); all on the same object, if there is one
 *
 * \param least_steps that a run tells */
template <typename Run>
void
interruptEveryStep(const Run& run, std::size_t least_steps)
{
  std::map<std::string, double> steps; // and the largest share that each tells
  const auto whole =
      run([&steps](const std::string& step, double done) { steps[step] = done; });
  EXPECT_LE(least_steps, steps.size());
  for (const auto& [step, last] : steps)
    for (const double least : {0.0, last}) {
      const std::string name = step;
      SCOPED_TRACE(name);
      EXPECT_THROW(run([&](const std::string& told, double done) {
                     if (told == name && done >= least)
                       throw Interrupted(name);
                   }),
                   Interrupted);
      EXPECT_TRUE(whole == run(nullptr));
    }
}

} // namespace uvol_test
