// SPDX-License-Identifier: LGPL-2.1-or-later
#include <undine/base/options/old_names.h>

#include <deal.II/base/utilities.h>

#include <algorithm>
#include <array>
#include <vector>

namespace undine
{
  namespace
  {
    struct Renaming
    {
      const char *old_path; ///< parts in <...> stand for any name
      const char *key;      ///< what the last part is called today
    };

    constexpr std::array<Renaming, 5> renamed_keys{
      {{"Output/Ledger", "Budget"},
       {"Effects/contact/Gap", "Activation distance"},
       {"Particles/Sub-steps/Places", "Position update"},
       {"Effects/scalar transport/<field>/Held boundaries", "Dirichlet boundaries"},
       {"Effects/scalar transport/<field>/Held value", "Dirichlet value"}}};

    bool
    fits(const std::string &pattern, const std::vector<std::string> &parts)
    {
      const auto expected = dealii::Utilities::split_string_list(pattern, '/');
      return expected.size() == parts.size() &&
             std::equal(expected.begin(),
                        expected.end(),
                        parts.begin(),
                        [](const std::string &word, const std::string &part) {
                          return word.front() == '<' || word == part;
                        });
    }
  } // namespace


  std::string
  current_path(const std::string &path)
  {
    const auto parts = dealii::Utilities::split_string_list(path, '/');
    for (const auto &renamed : renamed_keys)
      if (fits(renamed.old_path, parts))
        return path.substr(0, path.rfind('/') + 1) + renamed.key;
    return path;
  }
} // namespace undine
