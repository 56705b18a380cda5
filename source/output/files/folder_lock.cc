// SPDX-License-Identifier: LGPL-2.1-or-later
#include <undine/output/files/files.h>
#include <undine/output/files/folder_lock.h>

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <csignal>
#include <sstream>
#include <system_error>

namespace undine
{
  namespace
  {
    namespace fs = std::filesystem;

    /// Who holds a lock, as its file says.
    struct Holder
    {
      std::string host;
      long        process = 0;
    };

    const std::string first_line = "# A run of Undine is in this folder.";


    std::string
    this_host()
    {
      std::array<char, 256> name{};
      ::gethostname(name.data(), name.size() - 1);
      return name.data();
    }


    std::string
    text_of(const Holder &holder)
    {
      return first_line + "\nhost " + holder.host + "\nprocess " + std::to_string(holder.process) +
             "\n";
    }


    /// No host if the file is empty: its process had no time to write.
    Holder
    read_holder(const fs::path &file)
    {
      std::istringstream text(read_file(file));
      Holder             holder;
      std::string        line, word;
      if (std::getline(text, line) && line != first_line)
        throw FileError("'" + file.string() +
                        "' is in the way and no lock of this program. Move it away, or choose "
                        "another folder with --output.");
      text >> word >> holder.host >> word >> holder.process;
      return holder;
    }


    FileError
    in_use(const fs::path &file, const Holder &holder)
    {
      const auto folder = file.parent_path().string();
      const auto by     = holder.host.empty() ? std::string("by another run")
                                              : "by process " + std::to_string(holder.process) +
                                              " on the host '" + holder.host + "'";
      return FileError(
        "the folder '" + folder + "' is in use " + by +
        ". Wait for it, or choose another folder with --output" +
        (holder.host.empty() || holder.host == this_host()
           ? "."
           : "; if that process is no more, which cannot be seen from here, remove '" +
               file.string() + "'."));
    }


    /// Has the name been given to another file since it was opened?
    bool
    is_still(const fs::path &file, const int descriptor)
    {
      struct stat opened = {}, named = {};
      return ::fstat(descriptor, &opened) == 0 && ::stat(file.c_str(), &named) == 0 &&
             opened.st_ino == named.st_ino && opened.st_dev == named.st_dev;
    }


    /// True if the operating system, or, where it cannot lock, the process number says that nobody
    /// on this host holds the lock.
    bool
    take(const fs::path &file, const int descriptor)
    {
      if (::flock(descriptor, LOCK_EX | LOCK_NB) == 0)
        return true;
      if (errno == EWOULDBLOCK)
        return false;
      const auto holder = read_holder(file);
      return holder.process == 0 || (::kill(holder.process, 0) != 0 && errno == ESRCH);
    }
  } // namespace


  FolderLock::FolderLock(const fs::path &folder)
    : file(folder / "lock")
    , descriptor(-1)
  {
    do
      {
        if (descriptor >= 0)
          ::close(descriptor); // removed by the run that held it, while this one opened it
        descriptor = ::open(file.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0666);
        if (descriptor < 0)
          throw FileError(cannot_write(file, std::generic_category().message(errno)));
        try
          {
            if (!take(file, descriptor))
              throw in_use(file, read_holder(file));
            const auto holder = read_holder(file);
            if (!holder.host.empty() && holder.host != this_host())
              throw in_use(file, holder);
          }
        catch (const FileError &)
          {
            ::close(descriptor);
            throw;
          }
      }
    while (!is_still(file, descriptor));
    const auto text = text_of({this_host(), ::getpid()});
    if (::ftruncate(descriptor, 0) != 0 ||
        ::pwrite(descriptor, text.data(), text.size(), 0) != ssize_t(text.size()))
      {
        const auto reason = std::generic_category().message(errno);
        ::unlink(file.c_str());
        ::close(descriptor);
        throw FileError(cannot_write(file, reason));
      }
  }


  FolderLock::~FolderLock()
  {
    ::unlink(file.c_str());
    ::close(descriptor);
  }
} // namespace undine
