// SPDX-License-Identifier: LGPL-2.1-or-later
#include <undine/output/files.h>

#include <fcntl.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
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


    std::string
    mpi_reason(const int code)
    {
      char text[MPI_MAX_ERROR_STRING];
      int  length = 0;
      MPI_Error_string(code, text, &length);
      return std::string(text, length);
    }


    /// Write `text` at `offset` [bytes] in portions that MPI can count. All ranks take part in
    /// every portion, also after an error.
    int
    write_portions(MPI_Comm           communicator,
                   MPI_File           file,
                   const MPI_Offset   offset,
                   const std::string &text)
    {
      constexpr std::size_t portion = std::size_t(1) << 30;

      const std::uint64_t n_portions = dealii::Utilities::MPI::max(
        std::uint64_t((text.size() + portion - 1) / portion), communicator);
      int result = MPI_SUCCESS;
      for (std::uint64_t p = 0; p < n_portions; ++p)
        {
          const std::size_t begin = std::min(text.size(), p * portion);
          const std::size_t size  = std::min(text.size() - begin, portion);
          const int         code  = MPI_File_write_at_all(
            file, offset + begin, text.data() + begin, int(size), MPI_CHAR, MPI_STATUS_IGNORE);
          if (result == MPI_SUCCESS)
            result = code;
        }
      return result;
    }
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
    Descriptor(path, O_WRONLY | O_CREAT | O_APPEND).write(text);
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


  void
  write_file_together(const MPI_Comm communicator, const fs::path &path, const std::string &text)
  {
    const fs::path temporary = temporary_name(path);
    MPI_File       file      = MPI_FILE_NULL;
    int            code      = MPI_File_open(
      communicator, temporary.c_str(), MPI_MODE_CREATE | MPI_MODE_WRONLY, MPI_INFO_NULL, &file);
    throw_on_all_ranks(communicator,
                       code == MPI_SUCCESS ? "" : cannot_write(path, mpi_reason(code)));

    const std::uint64_t size   = text.size();
    std::uint64_t       offset = 0;
    MPI_Exscan(&size, &offset, 1, MPI_UINT64_T, MPI_SUM, communicator);
    if (dealii::Utilities::MPI::this_mpi_process(communicator) == 0)
      offset = 0; // MPI leaves it undefined
    code = MPI_File_set_size(file, 0);
    MPI_Barrier(communicator); // no rank may write before the others have emptied the file
    const int code_written = write_portions(communicator, file, offset, text);
    const int code_synced  = MPI_File_sync(file);
    const int code_closed  = MPI_File_close(&file);
    for (const int other : {code_written, code_synced, code_closed})
      if (code == MPI_SUCCESS)
        code = other;
    throw_on_all_ranks(communicator,
                       code == MPI_SUCCESS ? "" : cannot_write(path, mpi_reason(code)));
    on_first_rank(communicator, [&] { put_in_place(path); });
  }
} // namespace undine
