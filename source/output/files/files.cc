// SPDX-License-Identifier: LGPL-2.1-or-later
#include <undine/output/files/files.h>

#include <fcntl.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdlib>
#include <fstream>
#include <sstream>
#include <system_error>

namespace undine
{
  namespace
  {
    namespace fs = std::filesystem;

    std::string
    last_system_error()
    {
      return std::generic_category().message(errno);
    }


    /// A file of the operating system that is closed at the end of its scope.
    class Descriptor
    {
    public:
      Descriptor(const fs::path &path, const int flags)
        : path(path)
        , number(::open(path.c_str(), flags | O_CLOEXEC, 0666))
      {
        if (number < 0)
          throw FileError(cannot_write(path, last_system_error()));
      }

      Descriptor(const Descriptor &) = delete;
      Descriptor &
      operator=(const Descriptor &) = delete;

      ~Descriptor()
      {
        ::close(number);
      }

      void
      write(const std::string &text) const
      {
        for (std::size_t done = 0; done < text.size();)
          {
            const auto written = ::write(number, text.data() + done, text.size() - done);
            if (written < 0 && errno != EINTR)
              throw FileError(cannot_write(path, last_system_error()));
            done += std::max<ssize_t>(written, 0);
          }
      }

      /// Have the file system set `bytes` aside, then give them back.
      void
      try_size(const std::uintmax_t bytes) const
      {
        const int code    = ::posix_fallocate(number, 0, bytes);
        const int emptied = ::ftruncate(number, 0) == 0 ? 0 : errno;
        if (code != 0 || emptied != 0)
          throw FileError(
            cannot_write(path, std::generic_category().message(code != 0 ? code : emptied)));
      }

      void
      reach_disk() const
      {
        // Folders on some file systems cannot be synchronised and say EINVAL: nothing is lost then.
        if (::fsync(number) != 0 && errno != EINVAL)
          throw FileError(cannot_write(path, last_system_error()));
      }

    private:
      fs::path path;
      int      number;
    };
  } // namespace


  void
  throw_on_all_ranks(const MPI_Comm communicator, const std::string &failure)
  {
    const unsigned int n_ranks = dealii::Utilities::MPI::n_mpi_processes(communicator);
    const unsigned int rank    = dealii::Utilities::MPI::this_mpi_process(communicator);
    const unsigned int first =
      dealii::Utilities::MPI::min(failure.empty() ? n_ranks : rank, communicator);
    if (first < n_ranks)
      throw FileError(dealii::Utilities::MPI::broadcast(communicator, failure, first));
  }


  std::string
  cannot_write(const fs::path &path, const std::string &reason)
  {
    return "cannot write '" + path.string() + "': " + reason +
           ". Check the permissions of the folder and the free space, or choose another folder "
           "with --output.";
  }


  void
  make_folder(const fs::path &path)
  {
    std::error_code problem;
    fs::create_directories(path, problem);
    if (problem)
      throw FileError(cannot_write(path, problem.message()));
  }


  fs::path
  temporary_name(const fs::path &path)
  {
    return path.string() + ".part";
  }


  void
  assert_room(const fs::path &path, const std::uintmax_t bytes)
  {
    Descriptor(path, O_WRONLY | O_CREAT | O_TRUNC).try_size(bytes);
  }


  void
  reach_disk(const fs::path &path)
  {
    Descriptor(path, O_RDONLY).reach_disk();
  }


  void
  put_in_place(const fs::path &path)
  {
    const fs::path temporary = temporary_name(path);
    Descriptor(temporary, O_RDONLY).reach_disk();
    std::error_code problem;
    fs::rename(temporary, path, problem);
    if (problem)
      throw FileError(cannot_write(path, problem.message()));
    const fs::path folder = path.parent_path();
    Descriptor(folder.empty() ? fs::path(".") : folder, O_RDONLY | O_DIRECTORY).reach_disk();
  }


  void
  write_file(const fs::path &path, const std::string &text)
  {
    Descriptor(temporary_name(path), O_WRONLY | O_CREAT | O_TRUNC).write(text);
    put_in_place(path);
  }


  void
  append_to_file(const fs::path &path, const std::string &text)
  {
    const Descriptor file(path, O_WRONLY | O_CREAT | O_APPEND);
    const auto       old_size = fs::file_size(path);
    try
      {
        file.write(text);
      }
    catch (const FileError &)
      {
        // The part that found room goes, so that the file ends with a whole line.
        std::error_code ignored;
        fs::resize_file(path, old_size, ignored);
        throw;
      }
  }


  std::string
  read_file(const fs::path &path)
  {
    std::ifstream      in(path, std::ios::binary);
    std::ostringstream text;
    text << in.rdbuf();
    if (!in)
      throw FileError("cannot read '" + path.string() + "'");
    return text.str();
  }


  std::uint64_t
  digest(const std::uint64_t before, const std::string &text)
  {
    constexpr std::uint64_t basis = 0xCBF29CE484222325u, prime = 0x100000001B3u;
    std::uint64_t           value = before ^ basis;
    for (const unsigned char byte : text)
      value = (value ^ byte) * prime;
    return value ^ basis;
  }


  double
  leading_number(const std::string &line, const fs::path &path)
  {
    char        *end    = nullptr;
    const double number = std::strtod(line.c_str(), &end);
    if (end == line.c_str())
      throw FileError("'" + path.string() + "' was not written by this program or is damaged: '" +
                      line.substr(0, 40) +
                      "' is no number. Remove the line or the file and try again.");
    return number;
  }
} // namespace undine
