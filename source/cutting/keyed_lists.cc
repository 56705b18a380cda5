// SPDX-License-Identifier: LGPL-2.1-or-later
#include <undine/cutting/keyed_lists.h>

namespace undine
{
  namespace
  {
    constexpr std::size_t smallest_size = 64; // a power of two, so that a mask replaces division
  }


  IndexMap::IndexMap()
    : places(smallest_size, Place{-1, none})
    , mask(smallest_size - 1)
  {
  }


  void
  IndexMap::clear()
  {
    // A table that was large once is not worth sweeping for a few keys.
    if (places.size() > 16 * (keys.size() + smallest_size))
      places.assign(smallest_size, Place{-1, none});
    else
      places.assign(places.size(), Place{-1, none});
    mask = places.size() - 1;
    keys.clear();
  }


  int
  IndexMap::add(const std::int64_t key)
  {
    const int slot = find(key);
    if (slot != none)
      return slot;
    if (2 * (keys.size() + 1) > places.size())
      grow();
    keys.push_back(key);
    insert(key, keys.size() - 1);
    return keys.size() - 1;
  }


  void
  IndexMap::insert(const std::int64_t key, const int slot)
  {
    std::size_t at = hash(key);
    while (places[at].key >= 0)
      at = (at + 1) & mask;
    places[at] = {key, slot};
  }


  void
  IndexMap::grow()
  {
    places.assign(2 * places.size(), Place{-1, none});
    mask = places.size() - 1;
    for (std::size_t slot = 0; slot < keys.size(); ++slot)
      insert(keys[slot], slot);
  }


  void
  KeyedLists::clear()
  {
    slots.clear();
    ends.clear();
    successors.clear();
  }


  void
  KeyedLists::append(const std::int64_t key)
  {
    const int item = successors.size();
    const int slot = slots.add(key);
    if (slot == static_cast<int>(ends.size()))
      ends.push_back({item, item});
    else
      {
        successors[ends[slot].last] = item;
        ends[slot].last             = item;
      }
    successors.push_back(none);
  }
} // namespace undine
