// SPDX-License-Identifier: LGPL-2.1-or-later
#include <undine/output/files/files.h>
#include <undine/output/files/shared_file.h>

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <system_error>
#include <utility>

namespace undine
{
  namespace
  {
    std::string
    failure_at(const std::filesystem::path &path)
    {
      return cannot_write(path, std::generic_category().message(errno));
    }
  } // namespace


  SharedFile::SharedFile(const MPI_Comm communicator, const std::filesystem::path &path)
    : communicator(communicator)
    , path(path)
    , descriptor(::open(path.c_str(), O_WRONLY | O_CREAT | O_CLOEXEC, 0666))
  {
    if (descriptor < 0)
      failure = failure_at(path);
    try
      {
        throw_on_all_ranks(communicator, failure);
      }
    catch (const FileError &)
      {
        if (descriptor >= 0)
          ::close(descriptor);
        throw;
      }
  }


  SharedFile::~SharedFile()
  {
    if (descriptor >= 0)
      ::close(descriptor);
  }


  void
  SharedFile::make_empty()
  {
    on_first_rank(communicator, [&] {
      if (::ftruncate(descriptor, 0) != 0)
        throw FileError(failure_at(path));
    });
  }


  void
  SharedFile::write_at(std::uint64_t place, const char *data, std::size_t size)
  {
    while (size > 0 && failure.empty())
      {
        const auto written = ::pwrite(descriptor, data, size, place);
        if (written > 0)
          {
            place += written;
            data += written;
            size -= written;
          }
        else if (errno != EINTR)
          failure = failure_at(path);
      }
  }


  void
  SharedFile::close()
  {
    if (::fsync(descriptor) != 0 && failure.empty())
      failure = failure_at(path);
    if (::close(std::exchange(descriptor, -1)) != 0 && failure.empty())
      failure = failure_at(path);
    throw_on_all_ranks(communicator, failure);
  }


  void
  write_file_together(const MPI_Comm               communicator,
                      const std::filesystem::path &path,
                      const std::string           &text)
  {
    const std::uint64_t size = text.size();
    std::uint64_t       end  = 0; // of this rank's text
    MPI_Scan(&size, &end, 1, MPI_UINT64_T, MPI_SUM, communicator);
    SharedFile file(communicator, temporary_name(path));
    file.make_empty();
    file.write_at(end - size, text.data(), size);
    file.close();
    on_first_rank(communicator, [&] { put_in_place(path); });
  }
} // namespace undine
