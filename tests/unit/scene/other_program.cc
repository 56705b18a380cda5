// SPDX-License-Identifier: LGPL-2.1-or-later
#include <undine/driver/other_program.h>

#include <catch2/catch.hpp>

#include <chrono>

using namespace undine;
using std::chrono_literals::operator""s;

TEST_CASE("a program that succeeds has no reason, whatever it prints")
{
  REQUIRE(call_program({"sh", "-c", "echo out; echo err >&2"}, {}, 10s).empty());
}

TEST_CASE("the reason of a failure is its last line of errors")
{
  REQUIRE(call_program({"sh", "-c", "echo first >&2; echo last >&2; echo >&2; exit 3"}, {}, 10s) ==
          "last");
  REQUIRE(call_program({"sh", "-c", "exit 3"}, {}, 10s) == "'sh' has failed without a message");
  REQUIRE_THAT(call_program({"no-such-program-is-there"}, {}, 10s),
               Catch::Matchers::StartsWith("'no-such-program-is-there' cannot be started"));
}

TEST_CASE("more errors than a pipe holds do not block")
{
  REQUIRE(call_program(
            {"sh",
             "-c",
             "i=0; while [ $i -lt 3000 ]; do echo 'a line of sixty or so signs, again and again, "
             "without an end' >&2; i=$((i+1)); done; echo last >&2; exit 1"},
            {},
            20s) == "last");
}

TEST_CASE("variables are added to the environment or replaced in it")
{
  REQUIRE(call_program(
            {"sh", "-c", "test \"$UNDINE_A\" = 'b c' && test -n \"$PATH\""}, {"UNDINE_A=b c"}, 10s)
            .empty());
  REQUIRE(call_program({"sh", "-c", "test \"$HOME\" = /other"}, {"HOME=/other"}, 10s).empty());
}

TEST_CASE("a program that takes too long is ended, with all that it has started")
{
  const auto begin  = std::chrono::steady_clock::now();
  const auto reason = call_program({"sh", "-c", "sleep 60 & sleep 60"}, {}, 1s);
  REQUIRE(reason == "it takes longer than 1 s");
  REQUIRE(std::chrono::steady_clock::now() - begin < 20s);
}
