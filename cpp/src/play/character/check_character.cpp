// SPDX-License-Identifier: MIT
#include "character/check_character.hpp"

#include <cmath>
#include <limits>
#include <set>
#include <stdexcept>
#include <string>

#include "base/ranges.hpp"
#include "base/rounding.hpp"
#include "base/take_limits.hpp"
#include "motion/trunk.hpp"

namespace fragmotion {
namespace {

constexpr double kShortest = (1 - kFloatRounding) * kShortestFragment;  // s that a fragment may last

void require(bool holds, const char* what) {
  if (!holds) throw std::invalid_argument(std::string("its ") + what + " do not fit together");
}

bool all_within(const std::vector<int>& values, int least, int end) {
  for (const int value : values) {
    if (value < least || value >= end) return false;
  }
  return true;
}

bool all_in_range(const std::vector<double>& values, double least, double most) {
  for (const double value : values) {
    if (!(value >= least && value <= most)) return false;
  }
  return true;
}

void check_pool(const PackedPool& pool) {
  require(pool.skeleton.roles.hips >= 0, "roles");
  checked_skeleton(pool.skeleton);
  check_stature(pool.skeleton);
  for (std::size_t c = 0; c < pool.clips.size(); ++c) {
    if (c == 0 || pool.clips[c].grid != pool.clips[c - 1].grid) check(*pool.clips[c].grid, pool.skeleton);
    check(pool.clips[c]);
    const int original = original_of(pool.clips, c);
    require(original < static_cast<int>(c) && (original >= 0 || !pool.clips[c].mirrored),
            "clips and their mirror images");
  }
  for (const Fragment& f : pool.fragments) {
    require(f.clip >= 0 && f.clip < static_cast<int>(pool.clips.size()) && f.begin >= 0 && f.begin < f.end &&
                f.end < pool.clips[f.clip].frames && f.origin <= Origin::transformed,
            "fragments and clips");
    require(pool.seconds(f) >= kShortest && pool.seconds(f) <= kLongestCall, "fragments and rates");
  }
}

// A file holds them in steps, of which it tells some thousand millions.
void check_evident(const std::vector<Fragment>& fragments, double scale) {
  const auto is_told = [](double value) { return std::abs(value) <= kMostControl; };
  for (const Fragment& f : fragments) {
    const Control& ev = f.evident;
    require(is_told(scale * ev.x) && is_told(scale * ev.y) && is_told(ev.turn) && is_told(ev.jump), "evident controls");
  }
}

// Whose constructor bounds the numbers above.
void check_space(const ControlSpace& space) {
  const std::vector<double>& speeds = space.speeds();
  require(all_in_range(speeds, 1 / kMostOfSpace, kMostOfSpace) &&
              all_in_range({space.turn_rate(), space.scale()}, 1 / kMostOfSpace, kMostOfSpace),
          "controls");
}

// Classes that without_classes() leaves out match nothing.
void check_quality(const Quality& quality, std::size_t classes, std::size_t controls) {
  require(
      static_cast<std::size_t>(quality.classes) == classes && static_cast<std::size_t>(quality.controls) == controls &&
          quality.smoothness.size() == classes * classes && quality.match.size() == classes * controls &&
          all_in_range(quality.smoothness, std::numeric_limits<double>::min(), 1) && all_in_range(quality.match, 0, 1),
      "qualities");
}

// A row that summed to more than 1 would let values grow without end.
void check_model(const std::vector<double>& model, std::size_t controls) {
  require(model.size() == controls * controls, "control probabilities");
  for (std::size_t c = 0; c < controls; ++c) {
    double sum = 0;
    for (std::size_t next = 0; next < controls; ++next) {
      const double p = model[c * controls + next];
      require(p >= 0 && p <= 1, "control probabilities");
      sum += p;
    }
    require(std::abs(sum - 1) < 1e-6, "control probabilities");
  }
}

void check_contacts(const Character& c) {
  require(c.contacts.size() == c.pool.clips.size(), "contacts");
  for (std::size_t i = 0; i < c.contacts.size(); ++i) {
    const auto& feet = c.contacts[i].feet;
    for (std::size_t foot = 0; foot < feet.size(); ++foot) {
      require(feet[foot].size() == feet[foot ^ 1].size() &&
                  (feet[foot].empty() || feet[foot].size() == static_cast<std::size_t>(c.pool.clips[i].frames)),
              "contacts");
    }
    for (const FootHeights& floor : c.contacts[i].floors) {
      require(all_in_range({floor.ball, floor.heel}, -10 * kFarthestPlace, 10 * kFarthestPlace), "contacts");
    }
  }
}

// Moves' clips are the last ones, in the order of the moves, and no fragment's.
void check_moves(const Character& c) {
  require(c.moves.size() <= kMostMoves && c.moves.size() <= c.pool.clips.size(), "moves");
  for (const Fragment& f : c.pool.fragments) require(f.clip < c.takes(), "moves");
  for (std::size_t m = 0; m < c.moves.size(); ++m) {
    const Move& move = c.moves[m];
    require(move.clip == c.takes() + static_cast<int>(m), "moves");
    const PackedClip& clip = c.pool.clips[move.clip];
    require(all_within({move.loop_begin, move.loop_end}, 0, clip.frames), "moves");
    check_move_times(move.name, (clip.frames - 1) / clip.rate, move.wait,
                     {move.loop_begin / clip.rate, move.loop_end / clip.rate});
    require(!move.upper_body || Trunk(c.pool.skeleton).base >= 0, "moves");
  }
}

// All that a style of a character must be, without its moves.
void check_style(const Character& c) {
  check_pool(c.pool);
  check_space(c.space);
  check_evident(c.pool.fragments, c.space.scale());
  const std::size_t n = c.classes.count, fragments = c.pool.fragments.size(), controls = c.space.size();
  require(c.classes.count > 0 && c.classes.labels.size() == fragments && c.classes.representatives.size() == n &&
              all_within(c.classes.labels, 0, c.classes.count) &&
              all_within(c.classes.representatives, 0, static_cast<int>(fragments)),
          "classes");
  for (std::size_t k = 0; k < n; ++k) {
    require(c.classes.labels[c.classes.representatives[k]] == static_cast<int>(k), "representatives");
  }
  for (const std::vector<int>& members : c.classes.members()) require(!members.empty(), "classes");
  require(c.classes.inertia >= 0 && std::isfinite(c.classes.inertia), "classes");
  check_quality(c.quality, n, controls);
  require(!c.policies.empty(), "policy tables");
  for (const Policy& policy : c.policies) {
    require(policy.classes == c.classes.count && policy.controls == c.space.size() &&
                policy.next.size() == n * controls && all_within(policy.next, 0, c.classes.count),
            "policy tables");
  }
  require(c.bridges.size() == n * n && all_within(c.bridges, -1, c.classes.count), "stand-in-place classes");
  check_model(c.control_model, controls);
  check_contacts(c);
  for (const Leg& leg : c.legs.all) require(std::abs(leg.hinge.norm() - 1) < 1e-6, "legs");
}

// Styles have names of their own and the same policies, which a player finds by their number.
void check_styles(const Character& c) {
  require(c.styles.size() < kMostStyles && (c.styles.empty() || !c.style.empty()), "styles");
  std::set<std::string> names{c.style};
  for (const auto& style : c.styles) {
    require(!style->style.empty() && names.insert(style->style).second, "styles");
    require(style->moves.empty() && style->styles.empty(), "styles");
    require(std::equal(c.policies.begin(), c.policies.end(), style->policies.begin(), style->policies.end(),
                       [](const Policy& a, const Policy& b) { return a.name == b.name; }),
            "styles");
    check_style(*style);
  }
}

}  // namespace

void check_looks_and_arms(const Character& c) {
  const auto& [fastest, gaze] = c.looks;
  std::vector<double> values(fastest.begin(), fastest.end());
  values.insert(values.end(), {gaze.turn, gaze.chest, -gaze.down, gaze.up, c.arms[0].widest, c.arms[1].widest});
  bool fit = fastest.size() == look_bones(c.pool.skeleton).size() && all_in_range(values, 0, kPi * kHighestRate);
  for (const Vector3* axis : {&gaze.forward, &c.arms[0].arm.hinge, &c.arms[1].arm.hinge})
    fit = fit && std::abs(axis->norm() - 1) < kFloatRounding;
  require(fit, "looks and arms");
}

void check_character(const Character& c) {
  check_style(c);
  check_moves(c);
  check_styles(c);
}

}  // namespace fragmotion
