// SPDX-License-Identifier: MIT
#pragma once

#include <map>
#include <mutex>

namespace fragmotion {

/// What is made once of each key, for whichever of several threads asks first; the others wait for it.
template <typename Key, typename Value>
class Memo {
 public:
  /// What make() makes of the key; it stays where it is.
  template <typename Make>
  const Value& get(const Key& key, const Make& make) {
    Entry& entry = entry_of(key);
    std::call_once(entry.made, [&] { entry.value = make(); });
    return entry.value;
  }

 private:
  struct Entry {
    std::once_flag made;
    Value value{};
  };

  Entry& entry_of(const Key& key) {
    const std::scoped_lock lock(mutex_);
    return entries_[key];
  }

  std::mutex mutex_;
  std::map<Key, Entry> entries_;
};

}  // namespace fragmotion
