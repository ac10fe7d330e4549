// Suggestions for misspelt names: optimal string alignment distance (Damerau-Levenshtein without
// repeated edits; Boytsov, ACM JEA 16, 2011, section 2), ignoring case. Pure functions.
#include "core/error.h"

#include <algorithm>
#include <cctype>
#include <cstddef>

namespace octolux {
namespace {

std::string lower_case(std::string text) {
  for (char& c : text) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return text;
}

/// Insertions, deletions, substitutions and swaps of neighbours that turn `a` into `b`.
std::size_t edit_distance(const std::string& a, const std::string& b) {
  std::vector<std::size_t> before_last(b.size() + 1), last(b.size() + 1), row(b.size() + 1);
  for (std::size_t j = 0; j <= b.size(); ++j) last[j] = j;
  for (std::size_t i = 1; i <= a.size(); ++i) {
    row[0] = i;
    for (std::size_t j = 1; j <= b.size(); ++j) {
      const std::size_t substituted = last[j - 1] + (a[i - 1] == b[j - 1] ? 0 : 1);
      row[j] = std::min({last[j] + 1, row[j - 1] + 1, substituted});
      const bool swapped = i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1];
      if (swapped) row[j] = std::min(row[j], before_last[j - 2] + 1);
    }
    before_last.swap(last);
    last.swap(row);
  }
  return last[b.size()];
}

}  // namespace

std::string closest_name(const std::string& name, const std::vector<std::string>& candidates) {
  const std::string wanted = lower_case(name);
  // One slip per three letters; never so many that nothing of the name is left.
  const std::size_t allowed =
      std::min(std::max<std::size_t>(1, wanted.size() / 3), wanted.empty() ? 0 : wanted.size() - 1);
  std::string best;
  std::size_t best_distance = allowed + 1;
  for (const std::string& candidate : candidates) {
    const std::size_t distance = edit_distance(wanted, lower_case(candidate));
    if (distance < best_distance) {
      best = candidate;
      best_distance = distance;
    }
  }
  return best;
}

std::string unknown_name(const std::string& kind, const std::string& name,
                         std::vector<std::string> legal) {
  std::sort(legal.begin(), legal.end());
  legal.erase(std::unique(legal.begin(), legal.end()), legal.end());
  std::string text = "unknown " + kind + " '" + name + "'; legal: ";
  for (std::size_t i = 0; i < legal.size(); ++i) text += (i > 0 ? ", " : "") + legal[i];
  if (legal.empty()) text += "none";
  const std::string suggestion = closest_name(name, legal);
  if (!suggestion.empty()) text += " (did you mean '" + suggestion + "'?)";
  return text;
}

}  // namespace octolux
