// SPDX-License-Identifier: BSD-3-Clause
// Every file of the corpora, and what mutations with fixed seeds make of it, through
// the targets of the fuzzers: files that once broke a promise stay mended.
#include "support/environment.h"
#include "targets.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <thread>

namespace {

using uvol_fuzz::Target;
namespace fs = std::filesystem;

std::vector<fs::path>
listCorpus(const Target& target)
{
  std::vector<fs::path> files;
  const fs::path folder = fs::path(PCL_UVOL_SOURCE_DIR) / "tests/fuzz/corpus";
  for (const auto& entry : fs::directory_iterator(folder / target.name))
    files.push_back(entry.path());
  std::sort(files.begin(), files.end());
  return files;
}

void
runOn(const Target& target, const std::string& bytes, const std::string& name)
{
  try {
    target.run(reinterpret_cast<const std::uint8_t*>(bytes.data()), bytes.size());
  }
  catch (const std::exception& error) {
    ADD_FAILURE() << target.name << ", " << name << ": " << error.what();
  }
}

/** A few bytes replaced, removed or doubled. */
std::string
mutate(std::string bytes, uvol_test::Random& random)
{
  const auto below = [&random](std::size_t count) {
    return static_cast<std::size_t>(random.uniform() * static_cast<double>(count));
  };
  for (std::size_t change = 0; change <= below(4) && !bytes.empty(); ++change) {
    const std::size_t at = below(bytes.size()), count = 1 + below(8);
    switch (below(4)) {
    case 0:
      bytes[at] = static_cast<char>(below(256));
      break;
    case 1:
      bytes.erase(at, count);
      break;
    case 2:
      bytes.insert(at, bytes.substr(at, count));
      break;
    default:
      bytes.insert(at, std::to_string(-9 + static_cast<int>(below(1000))));
      break;
    }
  }
  return bytes;
}

/** 200, or what a call asks for: fuzzers are 25 times as slow on stages. */
std::size_t
countMutants()
{
  const char* const asked = std::getenv("UVOL_MUTANTS");
  return asked == nullptr ? 200 : std::stoul(asked);
}

class Corpus : public testing::TestWithParam<Target> {};

TEST_P(Corpus, BreaksNoPromise)
{
  const auto files = listCorpus(GetParam());
  EXPECT_FALSE(files.empty());
  for (const fs::path& file : files)
    runOn(GetParam(), uvol_test::readFile(file), file.filename());
}

TEST_P(Corpus, MutatedBreaksNoPromise)
{
  constexpr std::size_t most_bytes = 20000;
  const std::size_t mutants = countMutants();
  const auto files = listCorpus(GetParam());
  for (std::size_t i = 0; i < mutants; ++i) {
    const fs::path& file = files[i % files.size()];
    if (fs::file_size(file) > most_bytes)
      continue;
    uvol_test::Random random(i);
    runOn(GetParam(),
          mutate(uvol_test::readFile(file), random),
          file.filename().string() + " with seed " + std::to_string(i));
  }
}

/** Readers and stages share nothing that threads of a user could spoil: tsan looks on.
 */
TEST_P(Corpus, BreaksNoPromiseInThreadsOfAUser)
{
  const auto files = listCorpus(GetParam());
  std::vector<std::thread> threads;
  for (std::size_t first = 0; first < 3; ++first)
    threads.emplace_back([&files, first] {
      for (std::size_t i = 0; i < files.size(); ++i) {
        const fs::path& file = files[(first + i) % files.size()];
        runOn(GetParam(), uvol_test::readFile(file), file.filename());
      }
    });
  for (std::thread& thread : threads)
    thread.join();
}

INSTANTIATE_TEST_SUITE_P(Fuzz,
                         Corpus,
                         testing::ValuesIn(uvol_fuzz::listTargets()),
                         [](const auto& target) { return target.param.name; });

} // namespace
