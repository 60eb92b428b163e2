// SPDX-License-Identifier: MIT
//
// Two machines play one game over a bad line. Each plays both characters at once, takes the other's stick for what it
// was last until it hears of it, and then goes back and plays again what it had guessed wrong: FragmotionPlayer's save,
// restore and checksum are all that this takes.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <deque>
#include <fragmotion/fragmotion.hpp>
#include <random>
#include <vector>

namespace rollback {

namespace fm = fragmotion::game;

constexpr double kFrame = 1.0 / 60;
constexpr int kKept =
    64;  // frames that can be gone back to, and that each packet tells again, so that lost ones do no harm

/// What a packet tells of a player for a frame.
struct Stick {
  std::int8_t right = 0, up = 0;  // 127: pushed fully
  std::int8_t yaw = 0;            // of its camera, 1/256 of a turn
  std::uint8_t jump = 0;

  fm::Input input() const {
    const float turned = static_cast<float>(yaw) * 0.0245437F;
    const float forward[] = {-std::sin(turned), 0, -std::cos(turned)};
    return fm::by_camera(static_cast<float>(right) / 127, static_cast<float>(up) / 127, forward, jump != 0);
  }
  friend bool operator!=(const Stick& a, const Stick& b) { return std::memcmp(&a, &b, sizeof a) != 0; }
};

struct Packet {
  int frame = 0;  // of the newest stick
  std::array<Stick, kKept> sticks;
};

/// A line that delays, mixes up and loses.
class Line {
 public:
  explicit Line(unsigned seed) : random_(seed) {}
  double delay = 0.1, jitter = 0.03, loss = 0.05;

  void send(const Packet& packet, int now) {
    std::uniform_real_distribution<double> unit(0, 1);
    if (unit(random_) < loss) return;
    under_way_.push_back({now + static_cast<int>((delay + jitter * (unit(random_) - 0.5)) / kFrame), packet});
  }
  template <typename Take>
  void receive(int now, const Take& take) {
    for (std::size_t i = 0; i < under_way_.size();) {
      if (under_way_[i].first > now) {
        ++i;
      } else {
        take(under_way_[i].second);
        under_way_.erase(under_way_.begin() + static_cast<std::ptrdiff_t>(i));
      }
    }
  }

 private:
  std::mt19937 random_;
  std::deque<std::pair<int, Packet>> under_way_;
};

/// One of the two machines; `own`: which character is played here.
class Machine {
 public:
  int rollbacks = 0, longest = 0;  // how often it went back, and by how many frames at most

  Machine(int own, fm::Player first, fm::Player second) : own_(own), players_{std::move(first), std::move(second)} {}

  int frame() const { return frame_; }
  /// All frames before this one are what the other machine has seen as well.
  int agreed() const { return std::min(heard_ + 1, frame_); }
  const fm::PlayerRef& player(int index) const { return players_[static_cast<std::size_t>(index)]; }
  /// Of both characters as a frame begins; final where the frame is agreed.
  std::uint64_t checksum(int frame) const { return kept_[at(frame)].checksum; }

  /// Plays a frame on, unless the other machine is too far behind.
  void advance(Stick stick, Line& out, Line& in, int now) {
    int wrong = frame_;
    in.receive(now, [&](const Packet& packet) { wrong = std::min(wrong, hear(packet)); });
    if (wrong < frame_) play_again(wrong);
    if (frame_ - heard_ < kKept - 1) {
      sticks_[at(frame_)][mine()] = stick;
      sticks_[at(frame_)][other()] = heard_ >= frame_ ? sticks_[at(frame_)][other()] : last_heard_;
      step();
    }
    out.send(packet(), now);
  }

 private:
  struct Moment {
    std::array<std::vector<unsigned char>, 2> states;
    std::uint64_t checksum = 0;
  };
  static std::size_t at(int frame) { return static_cast<std::size_t>(frame) % (2 * kKept); }
  std::size_t mine() const { return static_cast<std::size_t>(own_); }
  std::size_t other() const { return 1 - mine(); }

  Packet packet() const {
    Packet packet;
    packet.frame = frame_ - 1;
    for (int back = 0; back < kKept && back < frame_; ++back) {
      packet.sticks[static_cast<std::size_t>(back)] = sticks_[at(frame_ - 1 - back)][mine()];
    }
    return packet;
  }

  // Takes what is new of a packet; the first frame that was played by another stick, or this one.
  int hear(const Packet& packet) {
    int wrong = frame_;
    for (int frame = std::max(heard_ + 1, packet.frame - kKept + 1); frame <= packet.frame; ++frame) {
      const Stick& told = packet.sticks[static_cast<std::size_t>(packet.frame - frame)];
      Stick& taken = sticks_[at(frame)][other()];
      if (frame < frame_ && taken != told) wrong = std::min(wrong, frame);
      taken = last_heard_ = told;
      heard_ = frame;
    }
    return wrong;
  }

  void play_again(int from) {
    const int now = frame_;
    ++rollbacks;
    longest = std::max(longest, now - from);
    for (std::size_t i = 0; i < 2; ++i) players_[i].restore(kept_[at(from)].states[i]);
    for (frame_ = from; frame_ < now;) {
      if (frame_ > heard_) sticks_[at(frame_)][other()] = last_heard_;
      step();
    }
  }

  void step() {
    Moment& moment = kept_[at(frame_)];
    moment.checksum = 0;
    for (std::size_t i = 0; i < 2; ++i) {
      players_[i].save(moment.states[i]);
      moment.checksum = moment.checksum * 31 + players_[i].checksum();
      players_[i].step(sticks_[at(frame_)][i].input(), kFrame);
    }
    ++frame_;
  }

  int own_, frame_ = 0, heard_ = -1;
  Stick last_heard_;
  std::array<fm::Player, 2> players_;
  std::array<std::array<Stick, 2>, 2 * kKept> sticks_;
  std::array<Moment, 2 * kKept> kept_;
};

/// Whether two machines had the same in the frames that they agree on; asked each frame.
class Umpire {
 public:
  int equal = 0, unequal = 0;
  std::uint64_t last = 0;

  void compare(const Machine& a, const Machine& b) {
    for (const int agreed = std::min(a.agreed(), b.agreed()); next_ < agreed; ++next_) {
      last = a.checksum(next_);
      ++(last == b.checksum(next_) ? equal : unequal);
    }
  }

 private:
  int next_ = 0;
};

}  // namespace rollback
