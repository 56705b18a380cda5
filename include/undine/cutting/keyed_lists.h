// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef undine_cutting_keyed_lists_h
#define undine_cutting_keyed_lists_h

#include <cstddef>
#include <cstdint>
#include <vector>

namespace undine
{
  /// Slots 0, 1, 2, ... for whole numbers >= 0, in the order in which they are first asked for
  /// (hash table with open addressing: cells, faces and edges of a grid of which few are cut).
  class IndexMap
  {
  public:
    static constexpr int none = -1;

    IndexMap();

    /// Forget all slots; keeps the memory.
    void
    clear();

    /// The slot of `key`; none if it has not got one.
    int
    find(const std::int64_t key) const
    {
      for (std::size_t at = hash(key);; at = (at + 1) & mask)
        if (places[at].key == key)
          return places[at].slot;
        else if (places[at].key < 0)
          return none;
    }

    /// The slot of `key`, given now if it has none yet.
    int
    add(const std::int64_t key);

    /// The key that has this slot.
    std::int64_t
    key(const int slot) const
    {
      return keys[slot];
    }

    /// Number of slots.
    int
    size() const
    {
      return keys.size();
    }

  private:
    struct Place
    {
      std::int64_t key;
      int          slot;
    };

    std::size_t
    hash(const std::int64_t key) const
    {
      // Runs of 16 neighbours stay together: what is asked for next is then in the cache.
      const std::uint64_t mixed = static_cast<std::uint64_t>(key >> 4) * 0x9E3779B97F4A7C15ull;
      return ((mixed >> 32 << 4) | (key & 15)) & mask;
    }

    void
    insert(const std::int64_t key, const int slot);

    void
    grow();

    std::vector<Place>        places;
    std::vector<std::int64_t> keys; ///< of each slot
    std::size_t               mask;
  };


  /// Items 0, 1, 2, ..., each in the list of one key; a list keeps the order of addition.
  class KeyedLists
  {
  public:
    static constexpr int none = -1;

    void
    clear();

    /// Append the next item, whose number is the number of items so far, to the list of `key`.
    void
    append(const std::int64_t key);

    /// The first item of a list; none if there is no such list.
    int
    first(const std::int64_t key) const
    {
      const int slot = slots.find(key);
      return slot == IndexMap::none ? none : ends[slot].first;
    }

    /// The item after `item` in its list; none at the end.
    int
    next(const int item) const
    {
      return successors[item];
    }

    /// The keys that have lists.
    const IndexMap &
    keys() const
    {
      return slots;
    }

  private:
    struct Ends
    {
      int first, last;
    };

    IndexMap          slots;
    std::vector<Ends> ends;
    std::vector<int>  successors;
  };
} // namespace undine

#endif
