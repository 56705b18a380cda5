// SPDX-License-Identifier: LGPL-2.1-or-later
#include <undine/base/options/options.h>
#include <undine/base/options/similar_words.h>
#include <undine/base/options/utf8.h>

#include <algorithm>
#include <set>

namespace undine
{
  namespace
  {
    /// Names become parts of file names, of XML and of columns' headers.
    bool
    can_be_a_name(const std::string &name)
    {
      return is_utf8(name) && std::all_of(name.begin(), name.end(), [](const unsigned char c) {
               return c >= 0x80 || std::isalnum(c) ||
                      std::string(" _-+.:()").find(c) != std::string::npos;
             });
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
    store->file     = std::move(file);
    store->mistakes = store->file.mistakes();
    throw_mistakes();
  }


  Options
  Options::collecting(ParameterFile file)
  {
    Options options;
    options.store           = std::make_shared<Store>();
    options.store->file     = std::move(file);
    options.store->mistakes = options.store->file.mistakes();
    options.store->collects = true;
    return options;
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
    return store->file.mentions(path);
  }


  std::vector<std::string>
  Options::named_sections(const std::string &example_name) const
  {
    if (is_reference())
      return {"<" + example_name + ">"};
    store->sections_of_names.insert(path);
    const auto names = store->file.subsections(path);
    for (const auto &name : names)
      if (!can_be_a_name(name))
        mistake(error("",
                      "'" + name + "' cannot be the name of a subsection",
                      "Allowed in names: letters, digits, blanks and _ - + . : ( )"));
    return names;
  }


  InputError
  Options::error(const std::string &key, const std::string &what, const std::string &hint) const
  {
    const auto       *assignment = store->file.find(path + key);
    const std::string place      = assignment != nullptr ? assignment->place : store->file.name();
    return InputError(place + ": " + section_label(path) +
                      (key.empty() ? "" : ", key '" + key + "'") + ": " + what +
                      (what.back() == '?' ? "" : ".") + (hint.empty() ? "" : "\n  " + hint));
  }


  std::vector<std::string>
  Options::undefined_values(const double since) const
  {
    std::vector<std::string> result;
    for (const auto &watched : store->watched)
      if (const std::string where = watched.undefined_since(since); !where.empty())
        {
          Options section = *this;
          section.path    = watched.section;
          result.emplace_back(
            section
              .error(watched.key,
                     "is not a finite number at " + where,
                     "Try: an expression that has a value wherever and whenever it is needed.")
              .what());
        }
    return result;
  }


  /// What is wrong with an assignment that no part has read.
  InputError
  Options::unknown(const std::string              &full_path,
                   const std::vector<std::string> &sections_of_others) const
  {
    const auto  slash = full_path.rfind('/');
    const bool  top   = slash == std::string::npos;
    std::string place = top ? "" : full_path.substr(0, slash + 1);
    std::string word  = top ? full_path : full_path.substr(slash + 1);

    const auto section_exists = [&](const std::string &section) {
      return store->sections_of_names.count(section) > 0 ||
             std::any_of(store->entries.begin(), store->entries.end(), [&](const Entry &entry) {
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
    const auto            insert_section = [&](const std::string &section) {
      if (section.size() > place.size() && section.compare(0, place.size(), place) == 0)
        names.insert(section.substr(place.size(), section.find('/', place.size()) - place.size()));
    };
    for (const auto &entry : store->entries)
      {
        insert_section(entry.section);
        if (entry.section == place)
          names.insert(entry.key);
      }
    if (unknown_section)
      std::for_each(sections_of_others.begin(), sections_of_others.end(), insert_section);
    if (unknown_section && names.count(word) > 0)
      return InputError(
        store->file.at(full_path).place + ": " + section_label(place) + ", subsection '" + word +
        "': it belongs to something that the scene does not choose. Try: remove it, or "
        "choose that, as in 'Output / Parts'.");
    const std::vector<std::string> known(names.begin(), names.end());
    const std::string              guess   = did_you_mean(known, word);
    std::string                    allowed = most_similar_first(known, word);
    if (store->sections_of_names.count(place) > 0)
      allowed +=
        std::string(allowed.empty() ? "" : ", and ") + "subsections with names of their own";
    return InputError(store->file.at(full_path).place + ": " + section_label(place) + ", " +
                      (unknown_section ? "subsection '" : "key '") + word + "': there is no such " +
                      (unknown_section ? "subsection" : "key") + " here." +
                      (guess.empty() ? "" : " " + guess) + "\n  Allowed: " + allowed + ".");
  }


  void
  Options::assert_all_used(const std::vector<std::string> &sections_of_others) const
  {
    // A section that is not known is told once, not for each of its lines.
    std::set<std::string> told;
    for (const auto &full_path : store->file.paths())
      {
        const bool judged = std::none_of(
          store->unjudged.begin(), store->unjudged.end(), [&](const std::string &section) {
            return full_path.compare(0, section.size(), section) == 0;
          });
        if (!judged || store->file.at(full_path).used)
          continue;
        const auto        found = unknown(full_path, sections_of_others);
        const std::string text  = found.what();
        if (told.insert(text.substr(store->file.at(full_path).place.size())).second)
          mistake(found);
      }
  }


  void
  Options::mistake(const InputError &found) const
  {
    if (!store->collects)
      throw found;
    // What is read twice is wrong twice.
    auto &all = store->mistakes;
    if (std::find(all.begin(), all.end(), found.what()) == all.end())
      all.push_back(found.what());
  }


  std::size_t
  Options::n_mistakes() const
  {
    return store->mistakes.size();
  }


  void
  Options::throw_mistakes() const
  {
    const auto &all = store->mistakes;
    if (all.empty())
      return;
    std::string text =
      all.size() == 1 ? all.front() : std::to_string(all.size()) + " mistakes in the scene:";
    if (all.size() > 1)
      for (const auto &one : all)
        text += "\n" + one;
    throw InputError(text);
  }


  bool
  Options::collects() const
  {
    return store->collects;
  }


  void
  Options::leave_unjudged(const std::string &key) const
  {
    store->unjudged.push_back(path + key);
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
