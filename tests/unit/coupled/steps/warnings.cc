// SPDX-License-Identifier: LGPL-2.1-or-later
#include <coupled/coupled_run.h>

using namespace undine_tests;

namespace
{
  /// A block that hits a pillar in its first step, since contact is not called for.
  std::string
  block_and_pillar(const std::string &coupling)
  {
    return section("Time", "set Step = .05") + section("Domain", "set Cells = 16, 16") +
           section("Fluid",
                   "set Density = 1\n" +
                     section("Boundaries",
                             section("open",
                                     "set Sides = left, top\nset Kind = pressure\n"
                                     "set Pressure = 0"))) +
           section("Bodies",
                   section("block",
                           "set Lower corner = .33, .33\nset Upper corner = .58, .6\n"
                           "set Cells = 2, 2\nset Density = 1000\nset Young's modulus = 1e6\n"
                           "set Poisson's ratio = .3\nset Initial velocity = 2; 0") +
                     section("pillar",
                             "set Lower corner = .6, .2\nset Upper corner = .8, .8\n"
                             "set Cells = 1, 3\nset Density = 1000\nset Young's modulus = 1e6\n"
                             "set Poisson's ratio = .3")) +
           section("Coupling", coupling);
  }
} // namespace


TEST_CASE("A report has one warning a subject, that of the first stage that has one", "[coupled]")
{
  Report report;
  report.warn("linear solver", "");
  CHECK(report.warnings.empty());
  report.warn("linear solver", "first");
  report.warn("linear solver", "second");
  report.warn("overlap", "third");
  REQUIRE(report.warnings.size() == 2);
  CHECK(report.warnings[0].text == "first");
  CHECK(report.warnings[1].text == "third");
}


TEST_CASE("A warning is new if the step before had none of its subject", "[coupled]")
{
  const std::vector<Report::Warning> none, one{{"a", "text"}},
    both{{"a", "other text"}, {"b", "B"}};
  CHECK(new_warnings(one, none) == std::vector<std::string>{"text"});
  CHECK(new_warnings(both, one) == std::vector<std::string>{"B"});
  CHECK(new_warnings(none, both).empty());
}


TEST_CASE("What is wrong in the first stage of a step is in its report", "[coupled][mpi]")
{
  for (const std::string coupling : {"", "set Maximum iterations = 1"})
    {
      INFO("Coupling: " << coupling);
      CoupledRun<2> run(block_and_pillar(coupling));
      CHECK(run.report.warnings.empty());
      run.step();
      CHECK(run.column("Flagged cells") > 0);
      bool overlap = false, fallback = false;
      for (const auto &warning : run.report.warnings)
        {
          overlap |= warning.text.find("'block' and 'pillar' overlap") != std::string::npos;
          fallback |= warning.text.find("solved directly") != std::string::npos;
        }
      CHECK(overlap);
      CHECK(fallback == !coupling.empty());
    }
}
