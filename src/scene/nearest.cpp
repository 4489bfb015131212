// SPDX-License-Identifier: MIT
#include "scene/nearest.hpp"

#include <algorithm>
#include <cctype>
#include <numeric>

namespace tamias2d::inline TAMIAS_PRECISION::scene {

namespace {

/// How many letters to insert, remove or replace to get from one word to the other; letters that
/// differ by case only count as equal.
std::size_t editDistance(std::string_view a, std::string_view b)
{
    const auto lower = [](char c) { return std::tolower(static_cast<unsigned char>(c)); };
    std::vector<std::size_t> row(b.size() + 1);
    std::iota(row.begin(), row.end(), std::size_t{0});
    for (std::size_t i = 0; i < a.size(); ++i) {
        std::size_t diagonal = row[0]++;
        for (std::size_t j = 0; j < b.size(); ++j) {
            const std::size_t replaced = diagonal + (lower(a[i]) == lower(b[j]) ? 0 : 1);
            diagonal = row[j + 1];
            row[j + 1] = std::min({replaced, row[j] + 1, row[j + 1] + 1});
        }
    }
    return row.back();
}

}  // namespace

std::string suggestion(std::string_view word, const std::vector<std::string>& known)
{
    // A name is near if at most a third of its letters differ; two always may.
    const std::size_t limit = std::max<std::size_t>(2, word.size() / 3);
    std::string best;
    std::size_t bestDistance = limit + 1;
    for (const std::string& candidate : known) {
        const std::size_t distance = word.size() > 64 ? bestDistance : editDistance(word, candidate);
        if (distance < bestDistance) best = candidate, bestDistance = distance;
    }
    if (!best.empty() && bestDistance < word.size()) return "; did you mean \"" + best + "\"?";

    std::string all = "; known: ";
    for (std::size_t i = 0; i < known.size(); ++i) all += (i == 0 ? "" : ", ") + known[i];
    return all;
}

}  // namespace tamias2d::inline TAMIAS_PRECISION::scene
