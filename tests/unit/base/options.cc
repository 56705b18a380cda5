// SPDX-License-Identifier: LGPL-2.1-or-later
#include <undine/base/options/options_output.h>
#include <undine/base/options/utf8.h>

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
  write_prm(prm, options);
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
  CHECK(other.find("'Time'") != std::string::npos);
  CHECK(other.find("Did you mean 'Time'?") != std::string::npos);
}


TEST_CASE("sections that the scene could have, and words, are guessed", "[options]")
{
  const auto wrong_section = read("subsection Boddies\n subsection ball\n  set Density = 1\n end\n"
                                  "end\nsubsection Fluid\n set Density = 1\n"
                                  " subsection Boundries\n  set Kind = wall\n end\nend\n");
  double     density       = 0;
  wrong_section.section("Fluid").add("Density", density, "", Allowed::positive(), "The density.");
  const auto complaint = [&](const std::vector<std::string> &others) {
    return message([&] { wrong_section.assert_all_used(others); });
  };
  CHECK(complaint({}).find("Did you mean") == std::string::npos);
  CHECK(complaint({"Bodies/", "Time/"}).find("Did you mean 'Bodies'?") != std::string::npos);

  const auto inner =
    read("subsection Fluid\n subsection Boundries\n  set Kind = wall\n end\nend\n");
  inner.section("Fluid").add("Density", density, "", Allowed::positive(), "The density.");
  CHECK(message([&] {
          inner.assert_all_used({"Fluid/", "Fluid/Boundaries/"});
        })
          .find("section 'Fluid', subsection 'Boundries': there is no such subsection here. "
                "Did you mean 'Boundaries'?") != std::string::npos);

  const auto  wrong_word = read("set Kind = cirle\n");
  std::string kind       = "circle";
  CHECK(message([&] {
          wrong_word.add("Kind", kind, "", Allowed::one_of({"box", "circle"}), "Its shape.");
        }).find("Did you mean 'circle'?") != std::string::npos);
}


TEST_CASE("all mistakes of a scene are reported at once", "[options]")
{
  std::ofstream("scene_under_test.prm") << "nonsense\n"
                                           "subsection Time\n set Stepp = 1\n set End = -3\nend\n"
                                           "subsection Bodies\n subsection a/b\n end\nend\n"
                                           "set Time/Start = 3\n";
  const auto options = Options::collecting(ParameterFile("scene_under_test.prm"));
  double     step = 1, end = 2;
  for (unsigned int reading = 0; reading < 2; ++reading) // what is read twice is told once
    {
      options.section("Time").require("Step", step, "s", Allowed::positive(), "The step.");
      options.section("Time").add("End", end, "s", Allowed::positive(), "The end.");
    }
  options.attempt([&] { throw options.error("Title", "is missing", ""); }, {"Title"});
  options.assert_all_used();
  CHECK(options.n_mistakes() == 7);
  CHECK(end == 2); // as before
  const auto text = message([&] { options.throw_mistakes(); });
  for (const std::string part : {"7 mistakes",
                                 ":1: cannot understand the line 'nonsense'",
                                 ":7: the name of subsection 'a/b'",
                                 ":10: the key 'Time/Start'",
                                 "key 'Step': must be given",
                                 ":4: section 'Time', key 'End'",
                                 "key 'Title': is missing",
                                 ":3: section 'Time', key 'Stepp'",
                                 "Did you mean 'Step'?"})
    CHECK_THAT(text, Catch::Contains(part));
}


TEST_CASE("a section that is not known is one mistake, however many lines it has", "[options]")
{
  std::ofstream("scene_under_test.prm") << "subsection Bodys\n subsection ball\n  set Density = 1\n"
                                           "  set Shape = ball\n  set Radius = 2\n end\nend\n";
  const auto options = Options::collecting(ParameterFile("scene_under_test.prm"));
  options.assert_all_used({"Bodies/"});
  CHECK(options.n_mistakes() == 1);
  CHECK_THAT(message([&] { options.throw_mistakes(); }),
             Catch::Contains("subsection 'Bodys': there is no such subsection here. Did you mean "
                             "'Bodies'?"));
}


TEST_CASE("where an 'end' is missing, lines that are not understood are told", "[options]")
{
  std::ofstream("scene_under_test.prm") << "subsection Time\n set End = 1\ned\n";
  const auto text = message([&] { ParameterFile("scene_under_test.prm"); });
  CHECK_THAT(text, Catch::Contains("section 'Time' is still open"));
  CHECK_THAT(text, Catch::Contains(":3: cannot understand the line 'ed'"));
}


TEST_CASE("what a reading that was given up has not read is no mistake", "[options]")
{
  std::ofstream("scene_under_test.prm") << "subsection Fluid\n set Density = 1\nend\n"
                                           "subsection Tim\n set End = 1\nend\n";
  const auto options = Options::collecting(ParameterFile("scene_under_test.prm"));
  options.attempt([&] { throw options.error("Domain", "is missing", ""); }, {"Fluid"});
  options.assert_all_used();
  const auto text = message([&] { options.throw_mistakes(); });
  CHECK(options.n_mistakes() == 2);
  CHECK_THAT(text, Catch::Contains("'Tim'") && !Catch::Contains("Density"));
}


TEST_CASE("a mistake that may follow from another is not reported", "[options]")
{
  std::ofstream("scene_under_test.prm") << "set Step = x\n";
  const auto options = Options::collecting(ParameterFile("scene_under_test.prm"));
  options.attempt([&] {
    double step = 0;
    options.add("Step", step, "s", Allowed::positive(), "The step.");
    throw options.error("Step", "is zero", "");
  });
  CHECK(options.n_mistakes() == 1);
}


TEST_CASE("unknown keys are no mistakes where the part they are about is not known", "[options]")
{
  std::ofstream("scene_under_test.prm") << "subsection Effects\n subsection gravitty\n"
                                           "  set Acceleration = 1\n end\nend\n";
  const auto options = Options::collecting(ParameterFile("scene_under_test.prm"));
  options.section("Effects").leave_unjudged("gravitty");
  options.assert_all_used();
  CHECK(options.n_mistakes() == 0);
}


TEST_CASE("numbers are read as they are written, or not at all", "[options]")
{
  const auto value = [](const std::string &text) {
    double number = 0;
    read_value(text, Allowed::anything(), number);
    return number;
  };
  for (const std::string text : {"1e-310", "5e-324", "-0.1", "1e308", "0.30000000000000004"})
    {
      const double number = value(text);
      CHECK(number == std::strtod(text.c_str(), nullptr));
      CHECK(value(write_value(number)) == number);
    }
  CHECK(value("max(1,2)/4") == 0.5);
  // muParser would give the last of several values.
  for (const std::string text :
       {"1,5", "1,4e6", "0,5,", "1;", "2+1,5", "(1,5)", "max(1,2),5", "", "1.5.2", "nan", "1e400"})
    CHECK_THROWS_AS(value(text), InputError);
  CHECK_THAT(message([&] { value("1,5"); }), Catch::Contains("with a point: 1.5"));
  // Of these the first three have finite values wherever they are evaluated.
  for (const std::string text : {"if(t>0,1,2)", "x^0", "rand()", "rand_seed(1)", "t", "y", "2*x"})
    CHECK_THROWS_AS(value(text), InputError);

  using Vector = dealii::Tensor<1, 2>;
  Vector vector;
  CHECK_THROWS_AS(read_value("1,5, 2", Allowed::anything(), vector), InputError);
  CHECK_THROWS_AS((Expression<2, 2>("1,5; 0")), InputError);
  CHECK_THROWS_AS((Expression<2>("rand()*x")), InputError);
  Expression<2> place;
  CHECK_THROWS_AS(read_value("x*t", Allowed::constant_in_time(), place), InputError);
  CHECK_NOTHROW(read_value("x*y", Allowed::constant_in_time(), place));
}


TEST_CASE("any text comes back from parameters.prm as it was", "[options]")
{
  for (const std::string text :
       {"a # b", "ends in \\", "\\", "\\#", "\\\\# x", "C:\\new", "#", "é # ü \\ x"})
    {
      ParameterFile file;
      file.set("Title=" + text);
      Options     options(file);
      std::string title;
      options.add("Title", title, "m", Allowed::anything(), "A title.");
      CHECK(title == text);
      std::ostringstream prm;
      write_prm(prm, options);
      std::string again;
      read(prm.str() + "set Other = 1\n").add("Title", again, "", Allowed::anything(), "A title.");
      CHECK(again == text);
    }
}


TEST_CASE("files as editors of other systems write them are read", "[options]")
{
  double step = 0;
  read("\xEF\xBB\xBFset Step = 3\r\n").add("Step", step, "", Allowed::anything(), "");
  CHECK(step == 3);
}


TEST_CASE("names that files of results cannot hold are refused", "[options]")
{
  for (const std::string name : {"a \"b\"<c", "a,b", "a;b", "a&b", "a=b", "a\\b", "[a]", "a'b"})
    CHECK_THROWS_AS(read("subsection " + name + "\nend\n").named_sections("x"), InputError);
  for (const std::string name : {"upper wall", "sheet_2", "Körper 1", "p-1.5 (left)"})
    CHECK(read("subsection " + name + "\nend\n").named_sections("x").front() == name);
}


TEST_CASE("--set takes nothing but Section/Key=value", "[options]")
{
  ParameterFile file;
  for (const std::string text :
       {"/=1", "=1", "a", "a/=1", "/a=1", "a//b=1", " =1", "a=b\nset c=d", "a=\x01"})
    CHECK_THROWS_AS(file.set(text), InputError);
  file.set("a/b = c=d");
  CHECK(file.at("a/b").value == "c=d");
}


TEST_CASE("files that include each other end with an error", "[options]")
{
  const auto write = [](const std::string &name, const std::string &text) {
    std::ofstream(name) << text;
  };
  // Each includes the next one twice: 2^40 inclusions.
  for (unsigned int k = 0; k < 40; ++k)
    {
      const auto next = "include_" + std::to_string(k + 1) + ".inc";
      write("include_" + std::to_string(k) + ".inc",
            "include " + next + "\ninclude " + next + "\n");
    }
  write("include_40.inc", "# nothing\n");
  CHECK_THAT(message([] { ParameterFile("include_0.inc"); }), Catch::Contains("more than 1000"));
}


TEST_CASE("files that are no scenes by their names are not read", "[options]")
{
  std::ofstream("secrets") << "root:x:0:0\n";
  for (const auto &text :
       {message([] { read("include secrets\n"); }), message([] { ParameterFile("secrets"); })})
    CHECK_THAT(text, Catch::Contains("'secrets' is not the name") && !Catch::Contains("root:x"));
}


TEST_CASE("lines that make no sense are refused with their number", "[options]")
{
  CHECK(message([] { read("subsection A\n"); }).find("'end' is missing") != std::string::npos);
  CHECK(message([] { read("end\n"); }).find(":1: 'end'") != std::string::npos);
  CHECK(message([] { read("\nsetStep 3\n"); }).find(":2: cannot") != std::string::npos);
  CHECK(message([] { read("set A = 1\nset A = 2\n"); }).find("set twice") != std::string::npos);
}


TEST_CASE("keys of settings of a study may be paths, others not", "[options]")
{
  const auto options = read("subsection Settings\n set Time/Step = 1 | 2\nend\n");
  CHECK(options.file().at("Settings/Time/Step").value == "1 | 2");
  CHECK_THAT(message([] { read("subsection Time\n set Fast/Step = 1\nend\n"); }),
             Catch::Contains("scene_under_test.prm:2") && Catch::Contains("must not contain '/'"));
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


TEST_CASE("texts that are no UTF-8 are shown and written to JSON as what can be read", "[options]")
{
  const std::string spoilt = "a\xff\xc3\xb6\x1b[2J\xc2\x9b\n";
  CHECK(valid_utf8(spoilt) == "a\xEF\xBF\xBD\xc3\xb6\x1b[2J\xc2\x9b\n");
  CHECK(printable(spoilt) == "a?\xc3\xb6?[2J?\n");
  CHECK(is_utf8("\xc3\xb6"));
  CHECK(!is_utf8("\xc3"));

  const auto  options = read("set Title = a\xff\n");
  std::string title;
  options.add("Title", title, "", Allowed::anything(), "What it is called.");
  CHECK(title == "a\xff");
  std::ostringstream json;
  write_json(json, options);
  CHECK(is_utf8(json.str()));
}


TEST_CASE("keys of earlier versions still work, and it is said what they are called", "[options]")
{
  const auto options = read("subsection Output\n set Ledger = true\nend\n"
                            "subsection Effects\n subsection scalar transport\n  subsection smoke\n"
                            "   set Held value = 3\n  end\n end\n"
                            " subsection contact\n  set Gap = 2\n end\nend\n");
  bool       budget  = false;
  double     value = 0, distance = 0;
  options.section("Output").add("Budget", budget, "", Allowed::anything(), "Terms.");
  const auto effects = options.section("Effects");
  const auto smoke   = effects.section("scalar transport").section("smoke");
  smoke.add("Dirichlet value", value, "", Allowed::anything(), "On boundaries.");
  effects.section("contact").add("Activation distance", distance, "", Allowed::anything(), "D.");
  options.assert_all_used();
  CHECK(budget);
  CHECK(value == 3);
  CHECK(distance == 2);
  const auto &remarks = options.file().remarks();
  REQUIRE(remarks.size() == 3);
  CHECK(remarks[0].find("scene_under_test.prm:2") == 0);
  CHECK(remarks[0].find("'Output/Ledger' is called 'Output/Budget'") != std::string::npos);
  CHECK(remarks[1].find("smoke/Dirichlet value") != std::string::npos);
  // Elsewhere the word may be a key of its own; and both names are one key.
  CHECK(read("subsection Bodies\n set Ledger = true\nend\n").file().remarks().empty());
  CHECK(
    message([] {
      read("subsection Output\n set Ledger = true\n set Budget = false\nend\n").assert_all_used();
    }).find("set twice") != std::string::npos);
}


TEST_CASE("a list with a value that is not allowed leaves the variable as it was", "[options]")
{
  const auto options = read("set Sides = left, lft\nset Point = 1, x\nset Numbers = 1, two\n");
  std::vector<std::string> sides{"top"};
  std::vector<double>      numbers{7};
  dealii::Tensor<1, 2>     point({3, 4});
  CHECK(message([&] {
          options.add("Sides", sides, "", Allowed::one_of({"left", "top"}), "Sides.");
        }).find("left, lft") != std::string::npos);
  CHECK(message([&] { options.add("Numbers", numbers, "", Allowed::anything(), "Numbers."); }) !=
        "no error");
  CHECK(message([&] { options.add("Point", point, "m", Allowed::anything(), "A point."); }) !=
        "no error");
  CHECK(sides == std::vector<std::string>{"top"});
  CHECK(numbers == std::vector<double>{7});
  CHECK(point == dealii::Tensor<1, 2>({3, 4}));
}


TEST_CASE("a line with a byte that is zero is refused with its number", "[options]")
{
  std::ofstream file("scene_under_test.prm", std::ios::binary);
  file << "set End = 1\nset St" << '\0' << "ep = 2\n";
  file.close();
  const ParameterFile scene("scene_under_test.prm");
  REQUIRE(scene.mistakes().size() == 1);
  CHECK(scene.mistakes().front().find("scene_under_test.prm:2: the line has a byte that is zero") ==
        0);
}
