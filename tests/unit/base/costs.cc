// SPDX-License-Identifier: LGPL-2.1-or-later
#include <undine/base/core/registry.h>
#include <undine/base/core/timing.h>

#include <catch2/catch.hpp>

using namespace undine;

TEST_CASE("work is that of all phases of a name, but not of those within one of them", "[costs]")
{
  TimingTree timing;
  for (unsigned int n = 0; n < 2; ++n)
    {
      const auto outer = timing.section("accelerate");
      const auto inner = timing.section("lift");
      timing.add("lift", 100);
    }
  {
    const auto outer = timing.section("diffuse");
    timing.add("lift", 3);
    timing.add("friction", 2);
  }
  const auto lift = timing.work_of("lift");
  CHECK(lift.calls == 3);
  CHECK(lift.seconds >= 3);
  CHECK(lift.seconds < 100); // of what is within it not one
  CHECK(timing.work_of("friction").seconds == 2);
  CHECK(timing.work_of("damping").calls == 0);
}


TEST_CASE("memory is what is held and, at its peak, what is there for a while besides", "[costs]")
{
  MemoryAccounts memory;
  memory.hold_briefly("lift", 10);
  CHECK(memory.of("lift").now == 0);
  CHECK(memory.of("lift").peak == 10);
  memory.hold("lift", 100);
  memory.hold_briefly("lift", 50);
  memory.hold("lift", 20);
  CHECK(memory.of("lift").now == 20);
  CHECK(memory.of("lift").peak == 150);
  CHECK(memory.of("damping").peak == 0);
}


namespace
{
  struct Part
  {
    virtual ~Part() = default;
  };
} // namespace


TEST_CASE("a hidden part is not there until it is shown again", "[costs]")
{
  auto                      &registry = Registry<Part>::instance();
  const Register<Part, Part> first("first", "One."), second("second", "Two.");
  {
    const auto hidden = registry.hide("first");
    CHECK(registry.names() == std::vector<std::string>{"second"});
    CHECK_THROWS_AS(registry.make("first"), InputError);
  }
  CHECK(registry.names().size() == 2);
  CHECK(registry.help("first") == "One.");
  CHECK(registry.make("first") != nullptr);
}
