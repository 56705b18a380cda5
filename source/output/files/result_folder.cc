// SPDX-License-Identifier: LGPL-2.1-or-later
#include <undine/output/files/files.h>
#include <undine/output/files/result_folder.h>

#include <algorithm>
#include <regex>
#include <sstream>

namespace undine
{
  namespace
  {
    namespace fs = std::filesystem;

    const std::string record_head =
      "# Files that runs of Undine have written into this folder: a new "
      "run replaces these and no others.";


    /// Does a run write files of this name?
    bool
    is_name_of_results(const fs::path &name)
    {
      static const std::regex pattern(
        "log\\.txt|original\\.prm|parameters\\.(prm|json)|statistics|"
        "timing|effects\\.json|summary\\.json|solution\\.(pvd|xdmf)|"
        "checkpoint/slot_[01]\\.h5|solution/[a-z]+_\\d{6,}\\.(vtu|h5)");
      return std::regex_match(name.generic_string(), pattern);
    }


    /// Names of files in the folder, and in its folders `solution` and `checkpoint`, that results
    /// have.
    std::vector<fs::path>
    find_results(const fs::path &folder)
    {
      std::vector<fs::path> result;
      for (const char *place : {"", "solution", "checkpoint"})
        {
          std::error_code ignored; // a folder that is not there holds nothing
          for (const auto &entry : fs::directory_iterator(folder / place, ignored))
            if (const auto name = place / entry.path().filename(); is_name_of_results(name))
              result.push_back(name);
        }
      std::sort(result.begin(), result.end());
      return result;
    }


    /// A line of the record is nothing to act upon if it leads out of the folder.
    bool
    stays_inside(const fs::path &name)
    {
      return !name.empty() && name.is_relative() &&
             std::find(name.begin(), name.end(), "..") == name.end();
    }


    bool
    is_there(const fs::path &file)
    {
      std::error_code ignored;
      return fs::exists(fs::symlink_status(file, ignored));
    }


    void
    remove_file(const fs::path &file)
    {
      std::error_code problem;
      if (is_there(file) && !fs::is_directory(fs::symlink_status(file, problem)))
        fs::remove(file, problem);
      if (problem)
        throw FileError("cannot remove '" + file.string() + "', a result of an earlier run: " +
                        problem.message() + ". Choose another folder with --output.");
    }
  } // namespace


  ResultFolder::ResultFolder(const MPI_Comm communicator, const fs::path &path)
    : communicator(communicator)
    , folder(path)
  {
    on_first_rank(communicator, [&] {
      for (auto above = folder; !above.empty() && !fs::exists(above); above = above.parent_path())
        made_folders.insert(made_folders.begin(), above);
      make_folder(folder);
      lock = std::make_unique<const FolderLock>(folder);
      read_record();
    });
    finished = dealii::Utilities::MPI::broadcast(communicator, finished);
  }


  ResultFolder::~ResultFolder()
  {
    lock.reset();
    std::error_code ignored;
    for (auto made = made_folders.rbegin(); made != made_folders.rend(); ++made)
      fs::remove(*made, ignored);
  }


  const fs::path &
  ResultFolder::path() const
  {
    return folder;
  }


  bool
  ResultFolder::is_finished() const
  {
    return finished;
  }


  fs::path
  ResultFolder::record() const
  {
    return folder / "record.txt";
  }


  void
  ResultFolder::read_record()
  {
    if (!is_there(record()))
      return;
    std::istringstream lines(read_file(record()));
    std::string        line;
    std::getline(lines, line);
    if (line != record_head)
      throw FileError("'" + record().string() +
                      "' is not what this program writes under this name. Move it away, or choose "
                      "another folder with --output.");
    while (std::getline(lines, line) && !lines.eof()) // a torn last line was never acted upon
      if (line.rfind("file ", 0) == 0 && stays_inside(line.substr(5)))
        names.insert(line.substr(5));
      else if (line.rfind("run ", 0) == 0)
        finished = line == "run has ended";
  }


  void
  ResultFolder::write_record() const
  {
    std::string text = record_head + "\n";
    for (const auto &name : names)
      text += "file " + name + "\n";
    write_file(record(), text + "run has begun\n");
  }


  void
  ResultFolder::assert_ours(const fs::path &name) const
  {
    const auto file = folder / name;
    if (names.count(name.generic_string()) == 0 &&
        (is_there(file) || is_there(temporary_name(file))))
      throw FileError("'" + (is_there(file) ? file : temporary_name(file)).string() +
                      "' is in the way: the record of what runs have written into this folder does "
                      "not name it. Move it away, or choose another folder with --output.");
  }


  void
  ResultFolder::assert_nothing_foreign() const
  {
    on_first_rank(communicator, [&] {
      for (const auto &name : find_results(folder))
        assert_ours(name);
    });
  }


  void
  ResultFolder::remove_results()
  {
    std::set<fs::path> folders;
    for (const auto &name : names)
      {
        remove_file(folder / name);
        remove_file(temporary_name(folder / name));
        if (fs::path(name).has_parent_path())
          folders.insert(folder / fs::path(name).parent_path());
      }
    std::error_code ignored;
    for (const auto &empty : folders)
      fs::remove(empty, ignored); // not if somebody else's files are in it
    names.clear();
  }


  void
  ResultFolder::begin()
  {
    assert_nothing_foreign();
    finished = false;
    on_first_rank(communicator, [&] {
      remove_results();
      write_record();
    });
  }


  void
  ResultFolder::go_on()
  {
    finished = false;
    on_first_rank(communicator, [&] {
      for (const auto &name : find_results(folder))
        names.insert(name.generic_string());
      write_record();
    });
  }


  void
  ResultFolder::claim(const fs::path &name)
  {
    on_first_rank(communicator, [&] {
      if (names.count(name.generic_string()) != 0)
        return;
      read_record(); // 'undine report' may have added a name meanwhile
      assert_ours(name);
      append_to_file(record(), "file " + name.generic_string() + "\n");
      reach_disk(record()); // before the file that it names does
      names.insert(name.generic_string());
    });
  }


  void
  ResultFolder::finish()
  {
    finished = true;
    on_first_rank(communicator, [&] { append_to_file(record(), "run has ended\n"); });
  }
} // namespace undine
