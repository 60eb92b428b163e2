// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "motion/clip.hpp"
#include "motion/soles.hpp"
#include "motion/steadiest_speed.hpp"

namespace fragmotion {

using Velocities = std::vector<Vector2>;

/// Of the way that a body goes: feet that tread come back, and go back no slower, none of them standing all the time.
constexpr double kTreads = 0.35;

/// Zero of none.
Vector2 mean_velocity(const Velocities& velocities);

/// How the ground goes back under a clip's soles, over windows of a thirtieth of a second, kGameRate of them in each
/// second whatever the clip's rate is: straight lines are between its frames.
class Treading {
 public:
  /// `scale`: by which lengths are those of a character of 1.8 m.
  Treading(std::vector<SolePath> soles, const Clip& clip, double scale);

  bool is_long_enough() const { return windows_ > 0; }

  /// The mean turn of what is flat on the ground, rad/s, to the other side: as the body turns against it.
  double turn() const;

  /// The body's velocity in each window, m/s, as it turns at `turn` about `center`; empty where no sole is low. Where
  /// the feet go forth and back on one path, nothing tells which is which: the body goes where it faces.
  Velocities velocities(double turn, const Vector2& center) const;

  /// The same where nothing on the ground tells forth from back: of legs that swing against each other like pendulums,
  /// which are as low, and go forth as fast as back, where they pass each other. Empty where feet do not alternate.
  Velocities striding(double turn, const Vector2& center) const;

  /// The speed at which what is low goes back, of the slower foot where both are, m/s: a mean.
  double slowest() const;

  /// How far a path, of the clip's frames, is over what stands, as the body sees it: the mean of the feet, m. Zero
  /// where a foot never stands.
  Vector3 over_feet(std::vector<Vector3> path) const;

  /// For each step of the clip from a frame to the next the velocity in its middle.
  Velocities steps(const Velocities& windows) const;

 private:
  // A point of a sole, and how surely it stands in each window, 0 to 1.
  struct Tread {
    std::size_t sole;
    const SolePoint* point;
    std::vector<double> stands;
  };
  // Windows in which a sole stands, and what it tells there.
  struct Told {
    std::vector<int> windows;
    Velocities velocities;
  };

  bool is_stiff() const;
  bool swings(double turn, const Vector2& center) const;
  Velocities strides(double turn, const Vector2& center) const;
  double ahead(std::size_t side, int f, double turn, const Vector2& center) const;
  double height(const SolePoint& point, int f) const;
  double steepness(const SolePoint& point, int f) const;
  double stands(const SolePoint& point, int f) const;
  double fastest_low(std::size_t sole, int f) const;
  Vector2 velocity(const std::vector<Vector3>& path, int f, double turn, const Vector2& center) const;
  Vector2 facing(int f) const;
  Vector2 add_circled(const std::vector<Vector3>& path, double turn, const Vector2& center, Velocities& sum) const;
  Told told(const Velocities& way, double turn, const Vector2& center) const;
  std::vector<int> standing(const std::vector<ToldSpeeds>& along, const std::vector<double>& usual) const;
  Velocities joined(const Told& told) const;
  double grip() const;

  double clip_rate_, rate_, scale_;
  int clip_frames_, span_, windows_ = 0;
  std::vector<SolePath> soles_;
  std::vector<double> headings_;  // [windows]
  std::vector<Tread> treads_;
  std::vector<double> low_;  // by foot, m over its lowest: what is lower is on the ground
};

}  // namespace fragmotion
