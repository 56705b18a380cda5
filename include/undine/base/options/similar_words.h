// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef undine_base_options_similar_words_h
#define undine_base_options_similar_words_h

#include <string>
#include <vector>

namespace undine
{
  /// "Did you mean 'Step'?": the known word that needs the fewest edits (Levenshtein's distance,
  /// upper and lower case alike) to become `word`, if at most a third of its letters need one;
  /// otherwise empty.
  std::string
  did_you_mean(const std::vector<std::string> &known, const std::string &word);

  /// "'Step', 'Steps', 'End'": the known words, those that are most like `word` first.
  std::string
  most_similar_first(std::vector<std::string> known, const std::string &word);
} // namespace undine

#endif
