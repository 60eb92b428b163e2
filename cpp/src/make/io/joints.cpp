// SPDX-License-Identifier: MIT
#include "io/joints.hpp"

#include <algorithm>
#include <limits>

#include "base/rounding.hpp"
#include "io/straying.hpp"
#include "skeleton/body_words.hpp"
#include "skeleton/bone_names.hpp"

namespace fragmotion {
namespace {

constexpr double kNever = std::numeric_limits<double>::infinity();

class JointFinder {
 public:
  JointFinder(const std::vector<std::string>& names, const std::vector<int>& parents, const double* poses, int frames,
              const std::vector<int>& bearing)
      : straying_(poses, frames, static_cast<int>(parents.size())), top_of_(parents.size(), -1) {
    const std::vector<BoneName> read = read_names(names);
    for (const int bone : bearing) {
      const int parent = parents[bone];
      top_of_[bone] = parent >= 0 && top_of_[parent] >= 0 ? top_of_[parent] : bone;
      if (top_of_[bone] == bone) tops_.push_back(bone), after_.push_back(top_above(parents, bone));
      if (!says_twist(read[bone])) carriers_.push_back(bone);
    }
    for (const int top : tops_) costs_.push_back(costs_of(top));
  }

  std::map<int, int> find() const {
    std::map<int, int> best;
    double least = kNever;
    for (std::size_t t = 0; t < tops_.size(); ++t) {
      if (after_[t] >= 0) continue;
      const int root = tops_[t];
      std::map<int, int> hanging;
      const double cost = grow(root, hanging);
      if (cost < least) least = cost, best = std::move(hanging);
    }
    return best;
  }

 private:
  // What moves a bone, though controls are between: it is joined before that.
  int top_above(const std::vector<int>& parents, int bone) const {
    do bone = parents[bone];
    while (bone >= 0 && top_of_[bone] < 0);
    return bone < 0 ? -1 : top_of_[bone];
  }

  std::vector<double> costs_of(int top) const {
    std::vector<double> costs;
    for (const int on : carriers_) {
      const bool is_own = top_of_[on] == top;
      costs.push_back(is_own ? kNever : straying_.of(top, on) + kFileRounding * straying_.apart(top, on));
    }
    return costs;
  }

  // Joins what is nearest first to what hangs together already, as Prim's tree grows; how far all joints go in it.
  double grow(int root, std::map<int, int>& hanging) const {
    std::vector<double> least(tops_.size(), kNever);
    std::vector<int> on(tops_.size(), -1);
    double sum = 0;
    for (int joined = root; joined >= 0;) {
      for (std::size_t c = 0; c < carriers_.size(); ++c) {
        if (top_of_[carriers_[c]] != joined) continue;
        for (std::size_t t = 0; t < tops_.size(); ++t) {
          if (costs_[t][c] < least[t]) least[t] = costs_[t][c], on[t] = carriers_[c];
        }
      }
      joined = -1;
      std::size_t next = 0;
      for (std::size_t t = 0; t < tops_.size(); ++t) {
        const auto is_joined = [&](int top) { return top == root || hanging.count(top) > 0; };
        const bool waits = !is_joined(tops_[t]) && on[t] >= 0 && (after_[t] < 0 || is_joined(after_[t]));
        if (waits && (joined < 0 || least[t] < least[next])) joined = tops_[t], next = t;
      }
      if (joined < 0) break;
      hanging[joined] = on[next];
      sum += least[next];
    }
    return hanging.size() + 1 == tops_.size() ? sum : kNever;
  }

  Straying straying_;
  std::vector<int> top_of_;  // of bearing bones: the one that they hang on by their parents, or are
  std::vector<int> tops_, after_, carriers_;
  std::vector<std::vector<double>> costs_;  // [tops, carriers]
};

}  // namespace

std::map<int, int> find_joints(const std::vector<std::string>& names, const std::vector<int>& parents,
                               const double* poses, int frames, const std::vector<int>& bearing) {
  return JointFinder(names, parents, poses, frames, bearing).find();
}

}  // namespace fragmotion
