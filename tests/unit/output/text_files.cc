// SPDX-License-Identifier: LGPL-2.1-or-later
#include <undine/output/files/schedule.h>
#include <undine/output/files/shared_file.h>
#include <undine/output/files/time_records.h>
#include <undine/output/statistics_file.h>

#include <boost/property_tree/xml_parser.hpp>
#include <catch2/catch.hpp>

#include <limits>
#include <sstream>

#include "sample_scene.h"

using namespace undine_tests;

namespace
{
  Columns
  row(const unsigned int step, const double energy)
  {
    return {{"Step", "1", double(step)}, {"Time", "s", step / 10.}, {"Energy", "J", energy}};
  }


  /// Steps of a file `statistics`.
  std::vector<unsigned int>
  steps(const std::string &text)
  {
    std::vector<unsigned int> result;
    std::istringstream        lines(text);
    for (std::string line; std::getline(lines, line);)
      if (line[0] != '#')
        result.push_back(std::stoi(line));
    return result;
  }


  void
  write_steps(const std::filesystem::path &path, const unsigned int n)
  {
    StatisticsFile file(MPI_COMM_WORLD, path, 0);
    for (unsigned int step = 0; step <= n; ++step)
      file.append(row(step, 1. / 3));
  }
} // namespace


TEST_CASE("statistics: a header and one row a step with ten digits", "[statistics][mpi]")
{
  TemporaryFolder folder;
  write_steps(folder.path / "statistics", 2);
  const auto text = read_file(folder.path / "statistics");
  CHECK(text.find("# 1: Step [1]\n# 2: Time [s]\n# 3: Energy [J]\n") == 0);
  CHECK(steps(text) == std::vector<unsigned int>{0, 1, 2});

  std::istringstream  last(text.substr(text.rfind('\n', text.size() - 2)));
  std::vector<double> values(3);
  std::string         word;
  last >> word >> values[1] >> values[2];
  CHECK(word == "2");
  CHECK(values[1] == Approx(0.2).epsilon(1e-14));
  CHECK(values[2] == Approx(1. / 3).epsilon(1e-9));
}


TEST_CASE("statistics: a resumed run drops later and torn rows", "[statistics][mpi]")
{
  TemporaryFolder folder;
  const auto      path = folder.path / "statistics";
  write_steps(path, 5);
  on_first_rank(MPI_COMM_WORLD, [&] { append_to_file(path, "   3   0.3"); }); // a row cut short
  StatisticsFile file(MPI_COMM_WORLD, path, 3);
  file.append(row(4, 7));
  const auto text = read_file(path);
  CHECK(steps(text) == std::vector<unsigned int>{0, 1, 2, 3, 4});
  CHECK(text.find("# 1: Step", 1) == std::string::npos); // one header
  CHECK(text.find("7.000000000e+00") != std::string::npos);
}


TEST_CASE("statistics: other columns than before are refused", "[statistics][mpi]")
{
  TemporaryFolder folder;
  write_steps(folder.path / "statistics", 3);
  StatisticsFile file(MPI_COMM_WORLD, folder.path / "statistics", 3);
  auto           columns = row(4, 1);
  columns.push_back({"Power", "W", 1});
  CHECK_THROWS_AS(file.append(columns), FileError);
  CHECK(steps(read_file(folder.path / "statistics")).size() == 4);
}


TEST_CASE("statistics: only the rows that were written are continued", "[statistics][mpi]")
{
  TemporaryFolder folder;
  const auto      path = folder.path / "statistics";
  write_steps(path, 5);
  std::uint64_t until_3 = 0;
  {
    StatisticsFile file(MPI_COMM_WORLD, path, 3);
    until_3 = file.digest();
    file.append(row(4, 1. / 3));
  }
  const auto whole   = read_file(path);
  const auto goes_on = [&](const std::uint64_t digest) {
    StatisticsFile::assert_continues(MPI_COMM_WORLD, path, 3, row(3, 0), digest);
  };
  const auto becomes = [&](const std::string &text) {
    on_first_rank(MPI_COMM_WORLD, [&] { write_file(path, text); });
  };
  CHECK_NOTHROW(goes_on(until_3));
  CHECK_NOTHROW(goes_on(0));

  auto changed                             = whole;
  changed[changed.find("3.333333333e-01")] = '4';
  becomes(changed);
  CHECK_THROWS_AS(goes_on(until_3), FileError);
  CHECK_NOTHROW(goes_on(0)); // which only a digest shows

  const auto row_2 = whole.find("\n                 2"), row_3 = whole.find("\n                 3");
  REQUIRE(row_3 != std::string::npos);
  becomes(whole.substr(0, row_3 + 1)); // ends too early
  CHECK_THROWS_AS(goes_on(0), FileError);
  becomes(whole.substr(0, row_2) + whole.substr(row_3)); // lacks a row
  CHECK_THROWS_AS(goes_on(0), FileError);
  becomes(whole.substr(whole.find('\n') + 1)); // lacks a line of the header
  CHECK_THROWS_AS(goes_on(0), FileError);
  CHECK(read_file(path) == whole.substr(whole.find('\n') + 1)); // nothing was changed
}


TEST_CASE("a digest of pieces is that of the whole", "[statistics]")
{
  CHECK(digest(digest(0, "ab"), "c") == digest(0, "abc"));
  CHECK(digest(0, "abc") != digest(0, "acb"));
  CHECK(digest(0, "") == 0);
}


TEST_CASE("statistics: what is not a number is named and not written", "[statistics][mpi]")
{
  TemporaryFolder folder;
  StatisticsFile  file(MPI_COMM_WORLD, folder.path / "statistics", 0);
  file.append(row(0, 1));
  for (const double value : {std::nan(""), std::numeric_limits<double>::infinity()})
    CHECK_THROWS_WITH(file.append(row(1, value)), Catch::Contains("'Energy'"));
  CHECK(steps(read_file(folder.path / "statistics")).size() == 1);
}


TEST_CASE("statistics: a full disk leaves whole rows", "[statistics][mpi]")
{
  TemporaryFolder folder;
  StatisticsFile  file(MPI_COMM_WORLD, folder.path / "statistics", 0);
  unsigned int    written = 0;
  {
    const FileSizeLimit limit(4096);
    const auto          fill_disk = [&] {
      for (; written < 1000; ++written)
        file.append(row(written, 1. / 3));
    };
    CHECK_THROWS_AS(fill_disk(), FileError);
  }
  MPI_Barrier(MPI_COMM_WORLD);
  const auto text = read_file(folder.path / "statistics");
  CHECK(written > 10);
  CHECK(steps(text).size() == written);
  CHECK(text.back() == '\n');
}


TEST_CASE("time records stay valid XML and follow a resumed run", "[records][mpi]")
{
  TemporaryFolder          folder;
  const auto               path = folder.path / "solution.pvd";
  const TimeRecords::Frame frame{"<Collection>\n", "</Collection>\n"};
  const auto               line = [](const double time) {
    return "<DataSet timestep=\"" + std::to_string(time) + "\"/>\n";
  };
  const auto times = [&] {
    boost::property_tree::ptree tree;
    boost::property_tree::read_xml(path.string(), tree);
    std::vector<double> result;
    for (const auto &child : tree.get_child("Collection"))
      if (child.first == "DataSet")
        result.push_back(child.second.get<double>("<xmlattr>.timestep"));
    MPI_Barrier(MPI_COMM_WORLD); // all have read before one writes again
    return result;
  };
  Clock clock;
  {
    TimeRecords records(MPI_COMM_WORLD, path, frame, clock);
    CHECK(times().empty());
    for (unsigned int n = 0; n < 4; ++n)
      {
        records.add(0.1 * n, line(0.1 * n));
        CHECK(times().size() == n + 1);
      }
  }
  clock.step = 20;
  clock.time = 0.1 + 0.1 + 1e-17; // as a sum of steps gives it
  TimeRecords records(MPI_COMM_WORLD, path, frame, clock);
  CHECK(times() == std::vector<double>{0, 0.1, 0.2});
  records.add(0.5, line(0.5));
  records.add(0.5, line(0.5));
  CHECK(times() == std::vector<double>{0, 0.1, 0.2, 0.5});
}


TEST_CASE("pictures are due at the start, at multiples of the interval and at the end",
          "[schedule]")
{
  Clock clock;
  clock.end_time         = 1;
  clock.landing_interval = 0.1;
  unsigned int due       = is_output_time(clock) ? 1 : 0;
  while (!clock.ended())
    {
      clock.advance(clock.land(0.03));
      due += is_output_time(clock) ? 1 : 0;
    }
  CHECK(due == 11);

  Clock without_interval;
  without_interval.end_time = 1;
  CHECK(is_output_time(without_interval));
  without_interval.advance(0.5);
  CHECK(!is_output_time(without_interval));
  without_interval.advance(0.5);
  CHECK(is_output_time(without_interval));
}


TEST_CASE("a file that cannot be written is an error on all ranks that names it", "[files][mpi]")
{
  TemporaryFolder folder;
  const auto      obstacle = folder.path / "file";
  on_first_rank(MPI_COMM_WORLD, [&] { write_file(obstacle, "not a folder"); });
  const auto inside = obstacle / "statistics";
  CHECK_THROWS_AS(StatisticsFile(MPI_COMM_WORLD, inside, 0), FileError);
  CHECK_THROWS_WITH(write_file_together(MPI_COMM_WORLD, inside, "text"),
                    Catch::Contains(inside.string()));
  CHECK_THROWS_AS(on_first_rank(MPI_COMM_WORLD, [&] { make_folder(inside); }), FileError);
}


TEST_CASE("a text written by all ranks is that of the ranks in turn", "[files][mpi]")
{
  TemporaryFolder    folder;
  const unsigned int rank    = dealii::Utilities::MPI::this_mpi_process(MPI_COMM_WORLD);
  const unsigned int n_ranks = dealii::Utilities::MPI::n_mpi_processes(MPI_COMM_WORLD);
  const auto         piece   = [](const unsigned int r) { return std::string(1000 * r, 'a' + r); };
  // A longer file of this name must not show through.
  write_file_together(MPI_COMM_WORLD, folder.path / "text", std::string(10000, 'x'));
  write_file_together(MPI_COMM_WORLD, folder.path / "text", piece(rank));
  std::string expected;
  for (unsigned int r = 0; r < n_ranks; ++r)
    expected += piece(r);
  CHECK(read_file(folder.path / "text") == expected);
}


TEST_CASE("a full disk is an error on all ranks and leaves the old file", "[files][mpi]")
{
  TemporaryFolder folder;
  const auto      path = folder.path / "text";
  write_file_together(MPI_COMM_WORLD, path, "old\n");
  std::string failure;
  {
    const FileSizeLimit limit(4096);
    try
      {
        write_file_together(MPI_COMM_WORLD, path, std::string(1 << 20, 'x'));
      }
    catch (const FileError &error)
      {
        failure = error.what();
      }
  }
  CHECK(failure.find(path.string()) != std::string::npos);
  CHECK(read_file(path).substr(0, 4) == "old\n");
}
