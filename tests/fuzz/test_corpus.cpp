// SPDX-License-Identifier: BSD-3-Clause
// Every file of the corpora, and what mutations with fixed seeds make of it, through
// the targets of the fuzzers: files that once broke a promise stay mended.
#include "support/environment.h"
#include "targets.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <limits>
#include <thread>

namespace test_corpus {

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

/** Changes files as fuzzers do. */
class Mutator {
public:
  Mutator(const std::vector<std::string>& files, std::uint64_t seed)
      : files_(files)
      , random_(seed)
  {
  }

  /** A few bytes replaced, removed, doubled or moved, numbers put in, and now and then
   * the end of another file. */
  std::string
  mutate(std::string bytes)
  {
    if (below(4) == 0)
      join(bytes, files_[below(files_.size())]);
    for (std::size_t change = 0; change <= below(8) && !bytes.empty(); ++change)
      changeBytes(bytes);
    return bytes;
  }

private:
  std::size_t
  below(std::size_t count)
  {
    return static_cast<std::size_t>(random_.uniform() * static_cast<double>(count));
  }

  void
  join(std::string& bytes, const std::string& other)
  {
    bytes = bytes.substr(0, below(bytes.size())) + other.substr(below(other.size()));
  }

  void
  changeBytes(std::string& bytes)
  {
    const std::size_t at = below(bytes.size()), count = 1 + below(16);
    switch (below(6)) {
    case 0:
      bytes[at] = static_cast<char>(below(256));
      break;
    case 1:
      bytes.erase(at, count);
      break;
    case 2:
      bytes.insert(at, bytes.substr(at, count));
      break;
    case 3:
      bytes.replace(at, count, bytes.substr(below(bytes.size()), count));
      break;
    case 4:
      putFloat(bytes, at);
      break;
    default:
      bytes.insert(at, std::to_string(-9 + static_cast<int>(below(1000))));
      break;
    }
  }

  void
  putFloat(std::string& bytes, std::size_t at)
  {
    constexpr float infinity = std::numeric_limits<float>::infinity();
    constexpr std::array<float, 10> special{
        {0.0f, 1.0f, -0.5f, 1e-43f, 1e-30f, 1e20f, -1e30f, 3e38f, infinity, NAN}};
    const float number = special[below(special.size())];
    char text[sizeof(number)];
    std::memcpy(text, &number, sizeof(number));
    bytes.replace(at, sizeof(number), text, sizeof(number));
  }

  const std::vector<std::string>& files_;
  uvol_test::Random random_;
};

/** What a call asks for by the environment. */
std::size_t
readCount(const char* variable, std::size_t by_default)
{
  const char* const asked = std::getenv(variable);
  return asked == nullptr ? by_default : std::stoul(asked);
}

class Corpus : public testing::TestWithParam<Target> {};

TEST_P(Corpus, BreaksNoPromise)
{
  const auto files = listCorpus(GetParam());
  EXPECT_FALSE(files.empty());
  for (const fs::path& file : files)
    runOn(GetParam(), uvol_test::readFile(file), file.filename());
}

/** \param end of the seeds, from the first on, unless the environment tells another */
void
runOnMutants(const Target& target, std::size_t first, std::size_t end)
{
  constexpr std::size_t most_bytes = 20000;
  std::vector<std::string> files;
  for (const fs::path& file : listCorpus(target))
    if (fs::file_size(file) <= most_bytes)
      files.push_back(uvol_test::readFile(file));
  end = readCount("UVOL_MUTANTS", end);
  for (std::size_t i = readCount("UVOL_FIRST_MUTANT", first); i < end; ++i)
    runOn(target,
          Mutator(files, i).mutate(files[i % files.size()]),
          "seed " + std::to_string(i));
}

constexpr std::size_t default_mutants = 50;

TEST_P(Corpus, MutatedBreaksNoPromise)
{
  runOnMutants(GetParam(), 0, default_mutants);
}

TEST_P(Corpus, MutatedBreaksNoPromise_long)
{
  runOnMutants(GetParam(), default_mutants, 1000);
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

} // namespace test_corpus
