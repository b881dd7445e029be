// SPDX-License-Identifier: BSD-3-Clause
// How far derived fields of random samples are from those of known flows, and how fast
// they converge.
#include "support/flows.h"

#include <cmath>
#include <cstdio>
#include <cstdlib>

using namespace uvol_test;

/** flows [SAMPLES]: per flow a row for that many samples, for 8 and for 64 times as
 * many. */
int
main(int argc, char** argv)
{
  const auto n = static_cast<std::size_t>(argc > 1 ? std::atof(argv[1]) : 8000);
  std::puts(
      "| flow | samples | gradient | order | curl | order | Q | order | lambda2 | "
      "order |\n|---|---|---|---|---|---|---|---|---|---|");
  for (const Flow& flow : makeFlows()) {
    const double distance = 3.0 * spacingOf(flow, n);
    FlowErrors before{};
    for (std::size_t samples = n; samples <= 64 * n; samples *= 8) {
      const FlowErrors now = measureDerivatives(flow, samples, samples, distance);
      const auto print = [&](double error, double coarser) {
        if (coarser > 0.0)
          std::printf(" %.1e | %.2f |", error, std::log2(coarser / error));
        else
          std::printf(" %.1e | |", error);
      };
      std::printf("| %s | %zu |", flow.name.c_str(), samples);
      print(now.gradient, before.gradient);
      print(now.curl, before.curl);
      print(now.q, before.q);
      print(now.lambda2, before.lambda2);
      std::puts("");
      before = now;
    }
  }
  return 0;
}
