// SPDX-License-Identifier: LGPL-2.1-or-later
#include <undine/base/options/options.h>

#include <algorithm>
#include <numeric>
#include <set>

namespace undine
{
  namespace
  {
    /// Number of edits that turn one word into the other (Levenshtein).
    unsigned int
    distance(const std::string &a, const std::string &b)
    {
      std::vector<unsigned int> row(b.size() + 1);
      std::iota(row.begin(), row.end(), 0);
      for (std::size_t i = 1; i <= a.size(); ++i)
        {
          unsigned int diagonal = row[0];
          row[0]                = i;
          for (std::size_t j = 1; j <= b.size(); ++j)
            {
              const unsigned int above   = row[j];
              const bool         differs = std::tolower(a[i - 1]) != std::tolower(b[j - 1]);
              row[j]   = std::min({above + 1, row[j - 1] + 1, diagonal + (differs ? 1 : 0)});
              diagonal = above;
            }
        }
      return row.back();
    }


    std::string
    most_similar_first(std::vector<std::string> names, const std::string &word)
    {
      std::stable_sort(names.begin(), names.end(), [&](const auto &a, const auto &b) {
        return distance(a, word) < distance(b, word);
      });
      std::string list;
      for (const auto &name : names)
        list += (list.empty() ? "'" : ", '") + name + "'";
      return list;
    }


    std::string
    section_label(const std::string &path)
    {
      return path.empty() ? "top level" : "section '" + path.substr(0, path.size() - 1) + "'";
    }
  } // namespace


  Options::Options(ParameterFile file)
    : store(std::make_shared<Store>())
  {
    store->file = std::move(file);
  }


  Options
  Options::for_reference()
  {
    Options options{ParameterFile()};
    options.store->reference = true;
    return options;
  }


  bool
  Options::is_reference() const
  {
    return store->reference;
  }


  Options
  Options::section(const std::string &name) const
  {
    Options result = *this;
    result.path += name + "/";
    return result;
  }


  Options
  Options::under_condition(const std::string &text) const
  {
    Options result   = *this;
    result.condition = text;
    return result;
  }


  const std::string *
  Options::assigned_text(const std::string &key) const
  {
    auto *assignment = store->file.find(path + key);
    if (assignment == nullptr)
      return nullptr;
    assignment->used = true;
    return &assignment->value;
  }


  void
  Options::record(Entry entry) const
  {
    entry.section   = path;
    entry.condition = condition;
    const auto same = [&](const Entry &other) {
      return other.section == entry.section && other.key == entry.key &&
             other.condition == entry.condition;
    };
    if (std::none_of(store->entries.begin(), store->entries.end(), same))
      store->entries.push_back(std::move(entry));
  }


  void
  Options::mark_required(const std::string &key) const
  {
    for (auto &entry : store->entries)
      if (entry.section == path && entry.key == key && entry.condition == condition)
        entry.required = true;
  }


  bool
  Options::given(const std::string &key) const
  {
    if (!key.empty())
      return store->file.find(path + key) != nullptr;
    const auto &paths = store->file.paths();
    return std::any_of(paths.begin(), paths.end(), [&](const std::string &other) {
      return other.compare(0, path.size(), path) == 0;
    });
  }


  std::vector<std::string>
  Options::named_sections(const std::string &example_name) const
  {
    if (is_reference())
      return {"<" + example_name + ">"};
    return store->file.subsections(path);
  }


  InputError
  Options::error(const std::string &key, const std::string &what, const std::string &hint) const
  {
    const auto       *assignment = store->file.find(path + key);
    const std::string place      = assignment != nullptr ? assignment->place : store->file.name();
    return InputError(place + ": " + section_label(path) +
                      (key.empty() ? "" : ", key '" + key + "'") + ": " + what +
                      (hint.empty() ? "." : ".\n  " + hint));
  }


  void
  Options::assert_all_used() const
  {
    for (const auto &full_path : store->file.paths())
      {
        const auto &assignment = store->file.at(full_path);
        if (assignment.used)
          continue;
        const auto  slash = full_path.rfind('/');
        const bool  top   = slash == std::string::npos;
        std::string place = top ? "" : full_path.substr(0, slash + 1);
        std::string word  = top ? full_path : full_path.substr(slash + 1);

        const auto section_exists = [&](const std::string &section) {
          return std::any_of(store->entries.begin(), store->entries.end(), [&](const Entry &entry) {
            return entry.section.compare(0, section.size(), section) == 0;
          });
        };
        bool unknown_section = false;
        while (!place.empty() && !section_exists(place))
          {
            unknown_section   = true;
            const auto parent = place.rfind('/', place.size() - 2);
            word              = place.substr(parent == std::string::npos ? 0 : parent + 1);
            word.pop_back();
            place = parent == std::string::npos ? "" : place.substr(0, parent + 1);
          }

        std::set<std::string> names;
        for (const auto &entry : store->entries)
          if (entry.section == place)
            names.insert(entry.key);
          else if (entry.section.compare(0, place.size(), place) == 0)
            names.insert(entry.section.substr(
              place.size(), entry.section.find('/', place.size()) + 1 - place.size()));
        throw InputError(
          assignment.place + ": " + section_label(place) + ", " +
          (unknown_section ? "subsection '" : "key '") + word + "': there is no such " +
          (unknown_section ? "subsection" : "key") +
          " here.\n  Allowed: " + most_similar_first({names.begin(), names.end()}, word) + ".");
      }
  }


  const std::vector<Options::Entry> &
  Options::entries() const
  {
    return store->entries;
  }


  const ParameterFile &
  Options::file() const
  {
    return store->file;
  }
} // namespace undine
