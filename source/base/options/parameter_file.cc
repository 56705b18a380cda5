// SPDX-License-Identifier: LGPL-2.1-or-later
#include <undine/base/core/errors.h>
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
    join(const std::vector<std::string> &sections)
    {
      std::string path;
      for (const auto &section : sections)
        path += section + "/";
      return path;
    }


    std::string
    without_comment(const std::string &line)
    {
      return dealii::Utilities::trim(line.substr(0, line.find('#')));
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
  } // namespace


  ParameterFile::ParameterFile(const std::string &file_name)
    : file_name(file_name)
  {
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
        std::string line = without_comment(raw);
        while (!line.empty() && line.back() == '\\' && std::getline(in, raw))
          {
            ++number;
            all_text += raw + "\n";
            line.back() = ' ';
            line += without_comment(raw);
          }
        if (line == "end" && sections.size() == depth_at_start)
          throw InputError(name + ":" + std::to_string(number) +
                           ": 'end' without an open subsection.");
        if (!line.empty())
          understand(line, name, number, sections);
      }
    if (sections.size() != depth_at_start)
      throw InputError(name + ": section '" + sections.back() +
                       "' is still open at the end of the file; an 'end' is missing.");
    open_files.pop_back();
  }


  void
  ParameterFile::include(const std::string              &name,
                         const std::string              &place,
                         const std::vector<std::string> &sections)
  {
    if (!std::filesystem::is_regular_file(name))
      throw FileError(place + ": cannot read the included file '" + name +
                      "'. Its path must be relative to the folder of the including file.");
    if (std::find(open_files.begin(), open_files.end(), std::filesystem::weakly_canonical(name)) !=
        open_files.end())
      throw InputError(place + ": the file '" + name +
                       "' includes itself, directly or by way of others.");
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
    if (line == "end")
      sections.pop_back();
    else if (!section.empty())
      {
        if (section.find('/') != std::string::npos)
          throw InputError(place + ": the name of subsection '" + section +
                           "' must not contain '/'.");
        sections.push_back(section);
        mention(join(sections));
      }
    else if (!included.empty())
      include((std::filesystem::path(file).parent_path() / included).string(), place, sections);
    else if (equals != std::string::npos && equals > 0)
      assign(join(sections) + dealii::Utilities::trim(setting.substr(0, equals)),
             {dealii::Utilities::trim(setting.substr(equals + 1)), file, place});
    else
      throw InputError(place + ": cannot understand the line '" + line +
                       "'.\n  Allowed: 'subsection NAME', 'set KEY = VALUE', 'end', "
                       "'include FILE' and comments that begin with '#'.");
  }


  void
  ParameterFile::mention(const std::string &section)
  {
    if (std::find(section_order.begin(), section_order.end(), section) == section_order.end())
      section_order.push_back(section);
  }


  void
  ParameterFile::set(const std::string &text)
  {
    const auto equals = text.find('=');
    if (equals == std::string::npos || equals == 0)
      throw InputError("command line: '--set " + text +
                       "' must have the form \"Section/Key=value\".");
    const std::string path = dealii::Utilities::trim(text.substr(0, equals));
    for (auto slash = path.find('/'); slash != std::string::npos; slash = path.find('/', slash + 1))
      mention(path.substr(0, slash + 1));
    assign(path,
           {dealii::Utilities::trim(text.substr(equals + 1)), "command line", "command line"});
  }


  void
  ParameterFile::assign(const std::string &path, const Assignment &assignment)
  {
    const auto found = assignments.find(path);
    if (found == assignments.end())
      order.push_back(path);
    else if (found->second.file == assignment.file && assignment.file != "command line")
      throw InputError(assignment.place + ": '" + path + "' is set twice; the first time at " +
                       found->second.place + ".");
    assignments[path] = assignment;
  }


  ParameterFile::Assignment *
  ParameterFile::find(const std::string &path)
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
    const auto given = assignments.find("Folder of files");
    return given != assignments.end() ? std::filesystem::path(given->second.value)
                                      : std::filesystem::path(file_name).parent_path();
  }


  const std::string &
  ParameterFile::text() const
  {
    return all_text;
  }
} // namespace undine
