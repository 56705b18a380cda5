// SPDX-License-Identifier: LGPL-2.1-or-later
#include <undine/output/files/files.h>
#include <undine/output/files/result_folder.h>

#include <catch2/catch.hpp>

#include <unistd.h>

#include "sample_scene.h"

using namespace undine_tests;

namespace
{
  void
  write(const std::filesystem::path &path, const std::string &text)
  {
    on_first_rank(MPI_COMM_WORLD, [&] {
      make_folder(path.parent_path());
      write_file(path, text);
    });
  }


  bool
  is_there(const std::filesystem::path &path)
  {
    MPI_Barrier(MPI_COMM_WORLD);
    const bool result = std::filesystem::exists(path);
    MPI_Barrier(MPI_COMM_WORLD);
    return result;
  }


  /// Does a run come to its end?
  enum class End
  {
    missed,
    reached
  };


  /// A run that writes some files.
  void
  run(const std::filesystem::path &path, const End end)
  {
    ResultFolder folder(MPI_COMM_WORLD, path);
    folder.begin();
    for (const char *name : {"statistics", "solution/fluid_000000.vtu", "checkpoint/slot_0.h5"})
      {
        folder.claim(name);
        write(path / name, "result");
      }
    if (end == End::reached)
      folder.finish();
  }
} // namespace


TEST_CASE("a new run replaces what runs have written, and nothing else", "[folder][mpi]")
{
  TemporaryFolder temporary;
  const auto      path = temporary.path / "results";
  run(path, End::reached);
  write(path / "solution" / "notes.txt", "mine");
  write(path / "pictures" / "one.png", "mine");
  write(path / "statistics.part", "left by a run that was killed");
  {
    ResultFolder folder(MPI_COMM_WORLD, path);
    CHECK(folder.is_finished());
    folder.begin();
    CHECK_FALSE(folder.is_finished());
  }
  CHECK_FALSE(is_there(path / "statistics"));
  CHECK_FALSE(is_there(path / "statistics.part"));
  CHECK_FALSE(is_there(path / "solution" / "fluid_000000.vtu"));
  CHECK_FALSE(is_there(path / "checkpoint")); // empty
  CHECK(read_file(path / "solution" / "notes.txt") == "mine");
  CHECK(read_file(path / "pictures" / "one.png") == "mine");
}


TEST_CASE("somebody else's files stop a run before it changes anything", "[folder][mpi]")
{
  TemporaryFolder   temporary;
  const auto        path = temporary.path / "results";
  const std::string name =
    GENERATE(as<std::string>(), "statistics", "solution/fluid_000007.vtu", "checkpoint/slot_1.h5");
  write(path / name, "mine");
  ResultFolder folder(MPI_COMM_WORLD, path);
  CHECK_THROWS_WITH(folder.begin(), Catch::Contains(name));
  CHECK_THROWS_WITH(folder.claim(name), Catch::Contains(name));
  CHECK(read_file(path / name) == "mine");
  CHECK_FALSE(is_there(path / "record.txt"));
  CHECK_NOTHROW(folder.go_on()); // a run whose record is lost
  CHECK_NOTHROW(folder.claim(name));
}


TEST_CASE("a file that appears while a run goes on is not replaced", "[folder][mpi]")
{
  TemporaryFolder temporary;
  ResultFolder    folder(MPI_COMM_WORLD, temporary.path / "results");
  folder.begin();
  write(temporary.path / "results" / "solution" / "bodies_000010.vtu", "mine");
  CHECK_THROWS_AS(folder.claim("solution/bodies_000010.vtu"), FileError);
}


TEST_CASE("the record tells runs that have ended from others", "[folder][mpi]")
{
  TemporaryFolder temporary;
  const auto      path = temporary.path / "results";
  for (const auto end : {End::missed, End::reached})
    {
      run(path, end);
      CHECK(ResultFolder(MPI_COMM_WORLD, path).is_finished() == (end == End::reached));
    }
  {
    ResultFolder folder(MPI_COMM_WORLD, path);
    folder.go_on();
  }
  CHECK_FALSE(ResultFolder(MPI_COMM_WORLD, path).is_finished());
}


TEST_CASE("a record that leads out of the folder, or is torn, is not acted upon", "[folder][mpi]")
{
  TemporaryFolder temporary;
  const auto      path = temporary.path / "results";
  run(path, End::reached);
  write(temporary.path / "mine.txt", "mine");
  write(path / "mine", "mine");
  on_first_rank(MPI_COMM_WORLD, [&] {
    append_to_file(path / "record.txt",
                   "file ../mine.txt\nfile " + (temporary.path / "mine.txt").string() +
                     "\nfile mine");
  });
  ResultFolder(MPI_COMM_WORLD, path).begin();
  CHECK(is_there(temporary.path / "mine.txt"));
  CHECK(is_there(path / "mine"));

  write(path / "record.txt", "my notes\n");
  CHECK_THROWS_WITH(ResultFolder(MPI_COMM_WORLD, path), Catch::Contains("record.txt"));
  CHECK(read_file(path / "record.txt") == "my notes\n");
}


TEST_CASE("folders that a run made and did not use go", "[folder][mpi]")
{
  TemporaryFolder temporary;
  {
    ResultFolder folder(MPI_COMM_WORLD, temporary.path / "a" / "b");
    CHECK(is_there(temporary.path / "a" / "b" / "lock"));
  }
  CHECK_FALSE(is_there(temporary.path / "a"));
}


TEST_CASE("only one run at a time is in a folder", "[folder][mpi]")
{
  TemporaryFolder temporary;
  const auto      file = temporary.path / "lock";
  {
    ResultFolder folder(MPI_COMM_WORLD, temporary.path);
    CHECK_THROWS_WITH(ResultFolder(MPI_COMM_WORLD, temporary.path),
                      Catch::Contains("in use by process"));
    CHECK(is_there(file));
  }
  CHECK_FALSE(is_there(file));

  std::array<char, 256> host{};
  gethostname(host.data(), host.size() - 1);
  const auto left_on = [&](const std::string &name) {
    write(file, "# A run of Undine is in this folder.\nhost " + name + "\nprocess 1\n");
  };
  left_on(host.data()); // by a process that holds it no more
  CHECK_NOTHROW(ResultFolder(MPI_COMM_WORLD, temporary.path));
  CHECK_FALSE(is_there(file));
  left_on("somewhere-else");
  CHECK_THROWS_WITH(ResultFolder(MPI_COMM_WORLD, temporary.path),
                    Catch::Contains("somewhere-else") && Catch::Contains("remove"));
  CHECK(is_there(file));
  write(file, "a lock of another program\n");
  CHECK_THROWS_AS(ResultFolder(MPI_COMM_WORLD, temporary.path), FileError);
  CHECK(read_file(file) == "a lock of another program\n");
}
