// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef undine_base_options_parameter_file_h
#define undine_base_options_parameter_file_h

#include <filesystem>
#include <map>
#include <string>
#include <vector>

namespace undine
{
  /// The assignments of a scene, before anything is known about their meaning. The syntax is that
  /// of deal.II's ParameterHandler (`subsection NAME`, `set KEY = VALUE`, `end`, `include FILE`,
  /// `#` comments, `\` at a line's end continues it), but, since named bodies and chosen parts
  /// decide which keys exist, the text is read before any key is declared. In values, `\#` stands
  /// for '#' and `\\` for a backslash. In a subsection `Settings`, which studies have, a key may be
  /// a path `Section/Key`. A line that makes no sense is left out and noted.
  class ParameterFile
  {
  public:
    struct Assignment
    {
      std::string value;
      std::string file;         ///< as given by the user; "command line" for --set
      std::string place;        ///< "scene.prm:12"
      bool        used = false; ///< some part has read it
    };

    /// An empty scene: every parameter has its default.
    ParameterFile() = default;

    /// Read a file. Throws FileError if it, or one that it includes, cannot be opened, InputError
    /// if its sections do not match or if it includes too much.
    explicit ParameterFile(const std::string &file_name);

    /// Apply `Section/Subsection/Key=value`; the value stands as it is, without comments. Throws
    /// InputError if it has another form.
    void
    set(const std::string &assignment);

    /// What is wrong with lines of the file, each with its place.
    const std::vector<std::string> &
    mistakes() const;

    /// What users may want to know about lines of the file that are no mistakes, each with its
    /// place: keys that have another name today.
    const std::vector<std::string> &
    remarks() const;

    /// `value` as a file must have it: the inverse of what reading does with `\`.
    static std::string
    escaped(const std::string &value);

    /// The assignment of `path` ("Section/Key"), or nullptr if the scene has none.
    /// @{
    Assignment *
    find(const std::string &path);
    const Assignment *
    find(const std::string &path) const;
    /// @}

    /// Does the scene set anything in the section, "Bodies/", or mention one within it, even an
    /// empty one?
    bool
    mentions(const std::string &section) const;

    /// The names of the subsections of `path` that the scene mentions, in order of appearance.
    std::vector<std::string>
    subsections(const std::string &path) const;

    /// Paths of all assignments, in order of appearance.
    const std::vector<std::string> &
    paths() const;

    const Assignment &
    at(const std::string &path) const;

    /// The name of the file read, "defaults" without one.
    const std::string &
    name() const;

    /// Where relative names of files in the scene begin: the top-level key `Folder of files` if the
    /// scene has it (a copy of the scene elsewhere does), else the folder of the file read.
    std::filesystem::path
    folder() const;

    /// The text read, included files in place.
    const std::string &
    text() const;

  private:
    void
    read(const std::string &file_name, std::vector<std::string> sections);

    /// The file `name`, which is included at `place`.
    void
    include(const std::string              &name,
            const std::string              &place,
            const std::vector<std::string> &sections);

    /// One line; `sections` are those open before and after it.
    void
    understand(const std::string        &line,
               const std::string        &file,
               unsigned int              number,
               std::vector<std::string> &sections);

    /// Note that the scene has a section ("Bodies/beam/").
    void
    mention(const std::string &section);

    void
    assign(const std::string &path, const Assignment &assignment);

    std::string                        file_name = "defaults";
    std::string                        all_text;
    std::map<std::string, Assignment>  assignments;
    std::vector<std::string>           order;
    std::vector<std::string>           section_order;
    std::vector<std::filesystem::path> open_files; ///< being read: the scene and what it includes
    unsigned int                       n_included = 0;
    std::vector<std::string>           line_mistakes;
    std::vector<std::string>           all_remarks;
  };
} // namespace undine

#endif
