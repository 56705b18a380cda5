// SPDX-License-Identifier: LGPL-2.1-or-later
#include <undine/base/core/registry.h>

#include <catch2/catch.hpp>

using namespace undine;

namespace
{
  struct Animal
  {
    virtual ~Animal() = default;
  };

  struct Cat : Animal
  {
  };
} // namespace


TEST_CASE("two parts of one kind cannot have the same name", "[registry]")
{
  auto      &animals  = Registry<Animal>::instance();
  const auto make_cat = [] { return std::make_unique<Cat>(); };
  animals.add("cat", "Purrs.", make_cat);
  CHECK_THROWS_WITH(animals.add("cat", "Hisses.", make_cat), Catch::Contains("'cat'"));
  CHECK(animals.help("cat") == "Purrs.");
  CHECK_NOTHROW(animals.add("kitten", "Sleeps.", make_cat));
}
