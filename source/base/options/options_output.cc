// SPDX-License-Identifier: LGPL-2.1-or-later
#include <undine/base/options/options_output.h>
#include <undine/base/options/utf8.h>

#include <boost/property_tree/json_parser.hpp>
#include <boost/property_tree/ptree.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <ostream>
#include <set>

namespace undine
{
  namespace
  {
    struct SectionTree
    {
      std::vector<const Options::Entry *>              entries;
      std::vector<std::pair<std::string, SectionTree>> sections;
    };


    SectionTree
    sort_by_section(const std::vector<Options::Entry> &entries)
    {
      SectionTree root;
      for (const auto &entry : entries)
        {
          SectionTree *place = &root;
          for (std::size_t begin = 0; begin < entry.section.size();)
            {
              const auto        end  = entry.section.find('/', begin);
              const std::string name = entry.section.substr(begin, end - begin);
              auto              at   = std::find_if(place->sections.begin(),
                                     place->sections.end(),
                                     [&](const auto &section) { return section.first == name; });
              if (at == place->sections.end())
                at = place->sections.insert(at, {name, SectionTree()});
              place = &at->second;
              begin = end + 1;
            }
          place->entries.push_back(&entry);
        }
      return root;
    }


    /// What the scene does not assign stays a comment: parts may ask what was given, and the file
    /// must give the same run.
    void
    write_prm_section(std::ostream        &out,
                      const SectionTree   &tree,
                      const ParameterFile &scene,
                      const std::string   &indent)
    {
      for (const auto *entry : tree.entries)
        {
          const bool assigned = scene.find(entry->section + entry->key) != nullptr;
          out << indent << (assigned ? "set " : "# default: ") << entry->key << " = "
              << ParameterFile::escaped(entry->value)
              << (entry->unit.empty() ? "" : "  # [" + entry->unit + "]") << '\n';
        }
      for (const auto &[name, section] : tree.sections)
        {
          out << '\n' << indent << "subsection " << name << '\n';
          write_prm_section(out, section, scene, indent + "  ");
          out << indent << "end\n";
        }
    }


    boost::property_tree::ptree
    json_section(const SectionTree &tree)
    {
      // push_back, not put: keys may contain dots. JSON must be UTF-8, a title may be anything.
      boost::property_tree::ptree json;
      for (const auto *entry : tree.entries)
        json.push_back({entry->key, boost::property_tree::ptree(valid_utf8(entry->value))});
      for (const auto &[name, section] : tree.sections)
        json.push_back({name, json_section(section)});
      return json;
    }


    std::string
    escaped(std::string text)
    {
      for (std::size_t at = 0; (at = text.find_first_of("|<>", at)) != std::string::npos; at += 2)
        text.insert(at, "\\");
      return text;
    }


    /// What a key takes: "number, > 0".
    std::string
    allowed_values(const Options::Entry &entry)
    {
      if (entry.allowed.empty() || entry.type == entry.allowed)
        return entry.type;
      return entry.type == "text" ? entry.allowed : entry.type + ", " + entry.allowed;
    }


    /// Parts that a scene can choose often share keys: such rows become one, with all conditions,
    /// or without any if one of them is always known.
    std::vector<Options::Entry>
    without_repetition(const std::vector<const Options::Entry *> &entries)
    {
      std::vector<Options::Entry> result;
      for (const auto *entry : entries)
        {
          const auto same =
            std::find_if(result.begin(), result.end(), [&](const Options::Entry &other) {
              return other.key == entry->key && other.help == entry->help &&
                     other.default_value == entry->default_value && other.unit == entry->unit &&
                     allowed_values(other) == allowed_values(*entry);
            });
          if (same == result.end())
            result.push_back(*entry);
          else if (same->condition.empty() || entry->condition.empty())
            same->condition.clear();
          else if (const auto name = entry->condition.find(" = "); name != std::string::npos)
            same->condition += " | " + entry->condition.substr(name + 3);
        }
      return result;
    }


    /// What a path and names that are looked for have in common: "/output/vtu/".
    std::string
    comparable(const std::string &path)
    {
      std::string result = "/";
      for (const char sign : path)
        if (sign == '/')
          {
            while (result.back() == ' ')
              result.pop_back();
            result += '/';
          }
        else if (sign != ' ' || result.back() != '/')
          result += std::tolower(static_cast<unsigned char>(sign));
      while (result.back() == ' ')
        result.pop_back();
      return result + '/';
    }


    /// Sections whose path contains `names`, as comparable(). Returns how many there are.
    unsigned int
    write_reference_section(std::ostream      &out,
                            const SectionTree &tree,
                            const std::string &path,
                            const std::string &names)
    {
      const bool   is_wanted = comparable(path).find(names) != std::string::npos;
      unsigned int n_found   = is_wanted && !tree.entries.empty();
      if (n_found > 0)
        {
          out << "\n## " << (path.empty() ? "Top level" : escaped(path)) << "\n\n"
              << "| key | default | allowed | unit | meaning |\n|---|---|---|---|---|\n";
          for (const auto &entry : without_repetition(tree.entries))
            out << "| " << escaped(entry.key) << " | "
                << (entry.required ? "*must be given*" : escaped(entry.default_value)) << " | "
                << escaped(allowed_values(entry)) << " | " << entry.unit << " | "
                << (entry.condition.empty() ? "" : "*" + escaped(entry.condition) + ":* ")
                << escaped(entry.help) << " |\n";
        }
      for (const auto &[name, section] : tree.sections)
        n_found += write_reference_section(
          out, section, path.empty() ? name : fmt::format("{} / {}", path, name), names);
      return n_found;
    }
  } // namespace


  void
  write_prm(std::ostream &out, const Options &options)
  {
    write_prm_section(out, sort_by_section(options.entries()), options.file(), "");
  }


  void
  write_json(std::ostream &out, const Options &options)
  {
    boost::property_tree::write_json(out, json_section(sort_by_section(options.entries())));
  }


  void
  write_reference(std::ostream &out, const Options &options)
  {
    write_reference_section(out, sort_by_section(options.entries()), "", "/");
  }


  bool
  write_reference_of(std::ostream &out, const Options &options, const std::string &names)
  {
    return write_reference_section(out, sort_by_section(options.entries()), "", comparable(names)) >
           0;
  }
} // namespace undine
