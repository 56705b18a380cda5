// SPDX-License-Identifier: LGPL-2.1-or-later
#include <undine/base/core/errors.h>
#include <undine/base/options/old_names.h>
#include <undine/base/options/parameter_file.h>

#include <deal.II/base/utilities.h>

#include <algorithm>
#include <filesystem>
#include <fstream>

namespace undine
{
  namespace
  {
    std::string
    path_of(const std::vector<std::string> &sections)
    {
      std::string path;
      for (const auto &section : sections)
        path += section + "/";
      return path;
    }


    // A scene includes a few files; more than these, and files include each other.
    constexpr unsigned int most_included = 1000;
    constexpr unsigned int deepest       = 50;


    /// The number of backslashes that end text[0, end).
    std::size_t
    backslashes_before(const std::string &text, const std::size_t end)
    {
      const auto other = text.find_last_not_of('\\', end == 0 ? std::string::npos : end - 1);
      return end == 0 ? 0 : (other == std::string::npos ? end : end - 1 - other);
    }


    std::string
    without_comment(const std::string &line)
    {
      auto comment = line.find('#');
      while (comment != std::string::npos && backslashes_before(line, comment) % 2 == 1)
        comment = line.find('#', comment + 1);
      return dealii::Utilities::trim(line.substr(0, comment));
    }


    bool
    is_continued(const std::string &line)
    {
      return backslashes_before(line, line.size()) % 2 == 1;
    }


    /// What a value in a file stands for: \# for '#', \\ for a backslash.
    std::string
    unescaped(const std::string &value)
    {
      std::string result;
      for (std::size_t i = 0; i < value.size(); ++i)
        {
          if (value[i] == '\\' && i + 1 < value.size() &&
              (value[i + 1] == '\\' || value[i + 1] == '#'))
            ++i;
          result += value[i];
        }
      return result;
    }


    /// A line for a message.
    std::string
    quoted(const std::string &line)
    {
      return "the line '" + line.substr(0, 100) + (line.size() > 100 ? "...'" : "'");
    }


    /// Messages quote what they are about: files that are no scenes, and may be private, are not
    /// read.
    void
    assert_name_of_scene(const std::string &file, const std::string &place)
    {
      const auto extension = std::filesystem::path(file).extension();
      if (extension != ".prm" && extension != ".inc")
        throw InputError(place + "'" + file +
                         "' is not the name of a scene. Scenes, and what they include, are called "
                         "NAME.prm or NAME.inc.");
    }


    /// The rest of `line` after `word` and blanks; empty if the line does not begin with the word.
    std::string
    rest_after(const std::string &line, const std::string &word)
    {
      if (line.compare(0, word.size(), word) != 0 || line.size() == word.size() ||
          !std::isspace(static_cast<unsigned char>(line[word.size()])))
        return "";
      return dealii::Utilities::trim(line.substr(word.size()));
    }


    /// Keys of a scene, as studies change them.
    bool
    may_name_paths(const std::vector<std::string> &sections)
    {
      return !sections.empty() && sections.back() == "Settings";
    }
  } // namespace


  ParameterFile::ParameterFile(const std::string &file_name)
    : file_name(file_name)
  {
    assert_name_of_scene(file_name, "");
    read(file_name, {});
  }


  void
  ParameterFile::read(const std::string &name, std::vector<std::string> sections)
  {
    std::ifstream in(name);
    if (!in || std::filesystem::is_directory(name))
      throw FileError("cannot read the parameter file '" + name +
                      "'. Check the path; the scenes that come with the program are in prm/.");

    open_files.push_back(std::filesystem::weakly_canonical(name));
    const std::size_t depth_at_start = sections.size();
    unsigned int      number         = 0;
    for (std::string raw; std::getline(in, raw);)
      {
        ++number;
        all_text += raw + "\n";
        if (const std::string mark = "\xEF\xBB\xBF"; number == 1 && raw.rfind(mark, 0) == 0)
          raw.erase(0, mark.size()); // the byte-order mark of UTF-8
        std::string line = without_comment(raw);
        while (is_continued(line) && std::getline(in, raw))
          {
            ++number;
            all_text += raw + "\n";
            line.back() = ' ';
            line += without_comment(raw);
          }
        if (line == "end" && sections.size() == depth_at_start)
          throw InputError(name + ":" + std::to_string(number) +
                           ": 'end' without an open subsection.");
        if (line.find('\0') != std::string::npos)
          line_mistakes.push_back(name + ":" + std::to_string(number) +
                                  ": the line has a byte that is zero. Is the file a text, and was "
                                  "it copied as a whole?");
        else if (!line.empty())
          understand(line, name, number, sections);
      }
    if (sections.size() != depth_at_start)
      {
        std::string text = name + ": section '" + sections.back() +
                           "' is still open at the end of the file; an 'end' is missing.";
        for (const auto &mistake : line_mistakes) // one of them may be the 'end', misspelt
          text += "\n" + mistake;
        throw InputError(text);
      }
    open_files.pop_back();
  }


  void
  ParameterFile::include(const std::string              &name,
                         const std::string              &place,
                         const std::vector<std::string> &sections)
  {
    assert_name_of_scene(name, place + ": ");
    if (!std::filesystem::is_regular_file(name))
      throw FileError(place + ": cannot read the included file '" + name +
                      "'. Its path must be relative to the folder of the including file.");
    if (std::find(open_files.begin(), open_files.end(), std::filesystem::weakly_canonical(name)) !=
        open_files.end())
      throw InputError(place + ": the file '" + name +
                       "' includes itself, directly or by way of others.");
    if (++n_included > most_included || open_files.size() > deepest)
      throw InputError(place + ": more than " + std::to_string(most_included) +
                       " files are included, or more than " + std::to_string(deepest) +
                       " within each other. Do files include each other again and again?");
    read(name, sections);
  }


  void
  ParameterFile::understand(const std::string        &line,
                            const std::string        &file,
                            const unsigned int        number,
                            std::vector<std::string> &sections)
  {
    const std::string place    = file + ":" + std::to_string(number);
    const std::string section  = rest_after(line, "subsection");
    const std::string included = rest_after(line, "include");
    const std::string setting  = rest_after(line, "set");
    const auto        equals   = setting.find('=');
    const std::string key      = dealii::Utilities::trim(setting.substr(0, equals));
    if (line == "end")
      sections.pop_back();
    else if (!section.empty())
      {
        sections.push_back(section);
        if (section.find('/') == std::string::npos)
          mention(path_of(sections));
        else
          line_mistakes.push_back(place + ": the name of subsection '" + section +
                                  "' must not contain '/'.");
      }
    else if (!included.empty())
      include((std::filesystem::path(file).parent_path() / included).string(), place, sections);
    else if (equals == std::string::npos || key.empty())
      line_mistakes.push_back(place + ": cannot understand " + quoted(line) +
                              ".\n  Allowed: 'subsection NAME', 'set KEY = VALUE', 'end', "
                              "'include FILE' and comments that begin with '#'.");
    else if (key.find('/') != std::string::npos && !may_name_paths(sections))
      line_mistakes.push_back(place + ": the key '" + key +
                              "' must not contain '/'.\n  Try: 'subsection NAME', 'set KEY = "
                              "VALUE' and 'end', each on a line of its own.");
    else
      assign(path_of(sections) + key,
             {unescaped(dealii::Utilities::trim(setting.substr(equals + 1))), file, place});
  }


  void
  ParameterFile::mention(const std::string &section)
  {
    if (std::find(section_order.begin(), section_order.end(), section) == section_order.end())
      section_order.push_back(section);
  }


  bool
  ParameterFile::mentions(const std::string &section) const
  {
    const auto is_within = [&](const std::string &other) {
      return other.size() > section.size() && other.compare(0, section.size(), section) == 0;
    };
    return std::any_of(order.begin(), order.end(), is_within) ||
           std::any_of(section_order.begin(), section_order.end(), is_within);
  }


  void
  ParameterFile::set(const std::string &text)
  {
    const auto        equals = text.find('=');
    const std::string path   = dealii::Utilities::trim(text.substr(0, equals));
    const auto        parts  = dealii::Utilities::split_string_list(path, '/');
    const auto        empty  = [](const std::string &part) { return part.empty(); };
    if (equals == std::string::npos || path.empty() || path.back() == '/' ||
        std::any_of(parts.begin(), parts.end(), empty))
      throw InputError("command line: '--set " + text +
                       "' must have the form \"Section/Key=value\".");
    if (std::any_of(
          text.begin(), text.end(), [](const unsigned char c) { return std::iscntrl(c); }))
      throw InputError("command line: '--set " + path +
                       "=...' contains a line break or another control character, which a scene "
                       "cannot hold.");
    for (auto slash = path.find('/'); slash != std::string::npos; slash = path.find('/', slash + 1))
      mention(path.substr(0, slash + 1));
    assign(path,
           {dealii::Utilities::trim(text.substr(equals + 1)), "command line", "command line"});
  }


  void
  ParameterFile::assign(const std::string &given_path, const Assignment &assignment)
  {
    const auto path = current_path(given_path);
    if (path != given_path)
      all_remarks.push_back(assignment.place + ": '" + given_path + "' is called '" + path +
                            "' now; the old name still works.");
    const auto found = assignments.find(path);
    if (found == assignments.end())
      order.push_back(path);
    else if (found->second.file == assignment.file && assignment.file != "command line")
      {
        line_mistakes.push_back(assignment.place + ": '" + path +
                                "' is set twice; the first time at " + found->second.place + ".");
        return;
      }
    assignments[path] = assignment;
  }


  const std::vector<std::string> &
  ParameterFile::mistakes() const
  {
    return line_mistakes;
  }


  const std::vector<std::string> &
  ParameterFile::remarks() const
  {
    return all_remarks;
  }


  std::string
  ParameterFile::escaped(const std::string &value)
  {
    std::string result;
    for (const char c : value)
      result += c == '\\' || c == '#' ? std::string{'\\', c} : std::string(1, c);
    return result;
  }


  ParameterFile::Assignment *
  ParameterFile::find(const std::string &path)
  {
    const auto found = assignments.find(path);
    return found == assignments.end() ? nullptr : &found->second;
  }


  const ParameterFile::Assignment *
  ParameterFile::find(const std::string &path) const
  {
    const auto found = assignments.find(path);
    return found == assignments.end() ? nullptr : &found->second;
  }


  std::vector<std::string>
  ParameterFile::subsections(const std::string &path) const
  {
    std::vector<std::string> names;
    for (const auto &section : section_order)
      if (section.size() > path.size() && section.compare(0, path.size(), path) == 0)
        {
          const std::string rest = section.substr(path.size());
          if (rest.find('/') == rest.size() - 1)
            names.push_back(rest.substr(0, rest.size() - 1));
        }
    return names;
  }


  const std::vector<std::string> &
  ParameterFile::paths() const
  {
    return order;
  }


  const ParameterFile::Assignment &
  ParameterFile::at(const std::string &path) const
  {
    return assignments.at(path);
  }


  const std::string &
  ParameterFile::name() const
  {
    return file_name;
  }


  std::filesystem::path
  ParameterFile::folder() const
  {
    const auto own   = std::filesystem::path(file_name).parent_path();
    const auto given = assignments.find("Folder of files");
    return given != assignments.end() ? own / given->second.value : own;
  }


  const std::string &
  ParameterFile::text() const
  {
    return all_text;
  }
} // namespace undine
