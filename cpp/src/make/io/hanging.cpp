// SPDX-License-Identifier: MIT
#include "io/hanging.hpp"

#include <algorithm>
#include <limits>
#include <numeric>

#include "io/straying.hpp"
#include "skeleton/bone_names.hpp"

namespace fragmotion {
namespace {

constexpr double kShare = 1.0 / 3;  // of what it goes as its parent sees it: feet of packs 0.02 to 0.21, others 1

// Of bones beside each other that go together, as the trunk and the legs of a body without a bone that carries them
// all, the one whose frame holds the others best: one that is no candidate, where none does so far better. `other`
// where it is none of them.
int hub_of(const Straying& straying, const std::vector<int>& parents, const std::vector<int>& candidates, int bone,
           int other) {
  if (parents[other] != parents[bone]) return other;
  std::vector<int> hubs(parents.size());
  std::iota(hubs.begin(), hubs.end(), 0);
  hubs.erase(std::remove_if(hubs.begin(), hubs.end(), [&](int b) { return parents[b] != parents[bone]; }), hubs.end());
  const auto is_candidate = [&](int b) { return std::count(candidates.begin(), candidates.end(), b) > 0; };
  std::stable_partition(hubs.begin(), hubs.end(), [&](int b) { return !is_candidate(b); });
  int best = hubs[0];
  double least = std::numeric_limits<double>::infinity();
  for (const int hub : hubs) {
    double strays = 0;
    for (const int held : candidates) strays += parents[held] == parents[bone] ? straying.of(held, hub) : 0;
    if (strays < kShare * least) least = strays, best = hub;
  }
  return best;
}

// Whether a bone moves another, which hangs on its parent or, where that is told, on another bone.
bool moves(const std::vector<int>& parents, const std::map<int, int>& hanging, int bone, int other) {
  if (other < 0 || other == bone) return other == bone;
  const auto on = hanging.find(other);
  return moves(parents, hanging, bone, parents[other]) ||
         (on != hanging.end() && moves(parents, hanging, bone, on->second));
}

}  // namespace

double span_beside(const double* poses, int frames, int bones, int bone, int other) {
  return Straying(poses, frames, bones).span(bone, other);
}

std::map<int, int> find_hanging(const std::vector<std::string>& names, const std::vector<int>& parents,
                                const double* poses, int frames, const std::vector<int>& candidates) {
  const std::vector<BoneName> read = read_names(names);
  const auto twin = [&](int bone) {  // on the other side; itself where it is on none
    const int other = read[bone].counterpart;
    return other >= 0 && read[other].counterpart == bone ? other : bone;
  };
  const Straying straying(poses, frames, static_cast<int>(parents.size()));
  std::map<int, int> hanging;
  for (const int bone : candidates) {
    if (hanging.count(bone)) continue;
    const bool is_paired = std::count(candidates.begin(), candidates.end(), twin(bone)) > 0;
    const int beside = is_paired ? twin(bone) : bone;
    double least = kShare * (straying.of(bone, parents[bone]) + straying.of(beside, parents[beside]));
    int best = -1;
    for (int other = 0; other < static_cast<int>(parents.size()); ++other) {
      const int besides = is_paired ? twin(other) : other;
      if (moves(parents, hanging, bone, other) || moves(parents, hanging, beside, other) ||
          moves(parents, hanging, beside, besides))
        continue;
      const double strays = straying.of(bone, other) + straying.of(beside, besides);
      if (strays < least) least = strays, best = other;
    }
    if (best < 0) continue;
    const int hub = beside == bone ? hub_of(straying, parents, candidates, bone, best) : best;
    if (hub == bone) continue;
    if (!moves(parents, hanging, bone, hub)) best = hub;
    hanging[bone] = best;
    if (is_paired) hanging[beside] = twin(best);
  }
  return hanging;
}

std::vector<int> ordered_bones(const std::vector<int>& parents, const std::vector<int>& hangs) {
  std::vector<int> order;
  std::vector<char> placed(hangs.size(), 0);
  const auto is_placed = [&](int bone) { return bone < 0 || placed[bone]; };
  for (std::size_t before = 1; order.size() != before;) {
    before = order.size();
    for (int b = 0; b < static_cast<int>(hangs.size()); ++b) {
      if (placed[b] || !is_placed(hangs[b]) || !is_placed(parents[b])) continue;
      placed[b] = 1;
      order.push_back(b);
    }
  }
  return order;
}

}  // namespace fragmotion
