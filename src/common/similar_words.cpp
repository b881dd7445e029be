// SPDX-License-Identifier: BSD-3-Clause
#include "common/similar_words.h"

#include "common/numbers.h"

#include <algorithm>

namespace pcl_uvol {

namespace {

/** Letters to insert, remove, replace or exchange with the next one (Damerau and
 * Levenshtein). */
std::size_t
editDistance(const std::string& a, const std::string& b)
{
  std::vector<std::size_t> row(b.size() + 1), above, top;
  for (std::size_t j = 0; j <= b.size(); ++j)
    row[j] = j;
  for (std::size_t i = 1; i <= a.size(); ++i) {
    top = std::move(above);
    above = row;
    row[0] = i;
    for (std::size_t j = 1; j <= b.size(); ++j) {
      const std::size_t substituted = above[j - 1] + (a[i - 1] != b[j - 1] ? 1 : 0);
      row[j] = std::min({substituted, above[j] + 1, row[j - 1] + 1});
      if (i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1])
        row[j] = std::min(row[j], top[j - 2] + 1);
    }
  }
  return row[b.size()];
}

/** The shortest word that begins with these letters, small or capital; "" if none does.
 */
std::string
findContinuation(const std::vector<std::string>& words, const std::string& letters)
{
  const std::string begin = lowerCase(letters);
  std::string shortest;
  for (const std::string& word : words)
    if (!begin.empty() && lowerCase(word).compare(0, begin.size(), begin) == 0 &&
        (shortest.empty() || word.size() < shortest.size()))
      shortest = word;
  return shortest;
}

} // namespace

std::string
findSimilar(const std::vector<std::string>& words, const std::string& word)
{
  std::string nearest = findContinuation(words, word);
  if (!nearest.empty())
    return nearest;
  std::size_t least = std::min(2 + word.size() / 4, word.size());
  for (const std::string& other : words)
    if (const std::size_t distance = editDistance(other, word); distance < least) {
      nearest = other;
      least = distance;
    }
  return nearest;
}

} // namespace pcl_uvol
