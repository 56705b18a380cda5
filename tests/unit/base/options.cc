// SPDX-License-Identifier: LGPL-2.1-or-later
#include <undine/base/options/options.h>

#include <catch2/catch.hpp>

#include <fstream>
#include <sstream>

using namespace undine;

namespace
{
  Options
  read(const std::string &text)
  {
    std::ofstream("scene_under_test.prm") << text;
    return Options(ParameterFile("scene_under_test.prm"));
  }


  template <class Action>
  std::string
  message(const Action &action)
  {
    try
      {
        action();
      }
    catch (const InputError &error)
      {
        return error.what();
      }
    return "no error";
  }
} // namespace


TEST_CASE("values are read, checked and written back", "[options]")
{
  const auto options = read("subsection Time\n set Step = 1/30 # comment\n"
                            " set Gravity = 0, -9.81\nend\n");
  double     step    = 1;
  options.section("Time").add("Step", step, "s", Allowed::positive(), "The step.");
  CHECK(step == 1. / 30);
  dealii::Tensor<1, 2> gravity;
  options.section("Time").add("Gravity", gravity, "m/s^2", Allowed::anything(), "Gravity.");
  CHECK(gravity[1] == -9.81);
  options.assert_all_used();

  std::ostringstream prm;
  options.write_prm(prm);
  const auto again = read(prm.str());
  double     same  = 0;
  again.section("Time").add("Step", same, "s", Allowed::positive(), "The step.");
  CHECK(same == step);
}


TEST_CASE("errors name file, line, section, key and allowed values", "[options]")
{
  const auto options = read("subsection Time\n set Step = -1\nend\n");
  double     step    = 1;
  const auto text    = message(
    [&] { options.section("Time").add("Step", step, "s", Allowed::positive(), "The step."); });
  CHECK(text.find("scene_under_test.prm:2") != std::string::npos);
  CHECK(text.find("section 'Time'") != std::string::npos);
  CHECK(text.find("key 'Step'") != std::string::npos);
  CHECK(text.find("> 0 [s]") != std::string::npos);
}


TEST_CASE("unknown keys and sections stop with the nearest names", "[options]")
{
  const auto declare = [](const Options &options) {
    double step = 1, end = 1;
    options.section("Time").add("Step", step, "s", Allowed::positive(), "The step.");
    options.section("Time").add("End", end, "s", Allowed::positive(), "The end.");
  };
  const auto wrong_key = read("subsection Time\n set Stepp = 1\nend\n");
  declare(wrong_key);
  const auto text = message([&] { wrong_key.assert_all_used(); });
  CHECK(text.find("key 'Stepp'") != std::string::npos);
  CHECK(text.find("Allowed: 'Step'") != std::string::npos);

  const auto wrong_section = read("subsection Tim\n set Step = 1\nend\n");
  declare(wrong_section);
  const auto other = message([&] { wrong_section.assert_all_used(); });
  CHECK(other.find("subsection 'Tim'") != std::string::npos);
  CHECK(other.find("'Time/'") != std::string::npos);
}


TEST_CASE("lines that make no sense are refused with their number", "[options]")
{
  CHECK(message([] { read("subsection A\n"); }).find("'end' is missing") != std::string::npos);
  CHECK(message([] { read("end\n"); }).find(":1: 'end'") != std::string::npos);
  CHECK(message([] { read("\nsetStep 3\n"); }).find(":2: cannot") != std::string::npos);
  CHECK(message([] { read("set A = 1\nset A = 2\n"); }).find("set twice") != std::string::npos);
}


TEST_CASE("expressions are functions of place and time", "[options]")
{
  const Expression<2> wave("sin(pi*x)*t + if(y>1, 10, 0)");
  CHECK(wave.value({0.5, 2.}, 3.) == Approx(13));
  const Expression<2, 2> shear("y; 0");
  CHECK(shear.vector({1., 7.}, 0.)[0] == Approx(7));
  CHECK(Expression<2, 2>("0, 0").is_zero());
  CHECK_THROWS_AS((Expression<2>("x +")), InputError);
  CHECK_THROWS_AS((Expression<2>("z")), InputError);
  CHECK_THROWS_AS((Expression<2, 2>("x")), InputError);
}
