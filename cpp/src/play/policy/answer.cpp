// SPDX-License-Identifier: MIT
#include "policy/answer.hpp"

#include <algorithm>
#include <limits>

namespace fragmotion {
namespace {

bool asks_for_motion(const Control& control) { return control.speed() > 0 && !control.jumps(); }
bool asks_to_stand(const Control& control) { return control.speed() == 0 && control.turn == 0 && !control.jumps(); }

// The classes that may play and answer a control, or stand where it asks to.
std::vector<int> answering_classes(const Quality& quality, const ControlSpace& space, int control,
                                   const std::vector<Control>& evident) {
  const Control& wanted = space.point(control);
  std::vector<int> answering;
  for (int k = 0; k < quality.classes; ++k) {
    const bool plays = quality.match[static_cast<std::size_t>(k) * quality.controls + control] > 0;
    if (plays && answers(evident[k], wanted) && (wanted.speed() > 0 || space.stands(evident[k])))
      answering.push_back(k);
  }
  return answering;
}

// What a table does while one control is held.
class HeldControl {
 public:
  HeldControl(Policy& policy, const Quality& quality, const ControlSpace& space, const std::vector<Control>& evident,
              const std::vector<int>& bridges, const std::vector<int>& strikes, int control)
      : policy_(policy),
        quality_(quality),
        space_(space),
        evident_(evident),
        bridges_(bridges),
        strikes_(strikes),
        control_(control),
        answering_(answering_classes(quality, space, control, evident)) {
    if (space.point(control).speed() == 0) return;
    for (const int feet : strikes) all_strikes_ |= std::max(feet, 0);
  }

  void answer() {
    find_cycles();
    if (answering_.empty() || std::count(leads_to_answer_.begin(), leads_to_answer_.end(), 0) == 0) return;
    if (goals().empty() && !steps_on()) {
      all_strikes_ = 0;
      return answer();
    }
    const std::vector<int> goals = this->goals();
    for (const int k : unanswered_) next(k) = goals.empty() ? next(k) : best_of(goals, k);
  }

 private:
  int& next(int from) { return policy_.next[static_cast<std::size_t>(from) * policy_.controls + control_]; }
  int bridge(int from, int to) const { return bridges_[static_cast<std::size_t>(from) * quality_.classes + to]; }

  // Classes that answer, and lead to what does.
  std::vector<int> goals() const {
    std::vector<int> goals;
    for (const int k : answering_) {
      if (leads_to_answer_[k]) goals.push_back(k);
    }
    return goals;
  }

  // Lets each class that answers be followed by one that does with another foot, if that makes a cycle that answers.
  bool steps_on() {
    const std::vector<int> before = policy_.next;
    for (const int k : answering_) {
      const std::vector<int> steps = next_steps(k);
      if (!steps.empty()) next(k) = best_of(steps, k);
    }
    find_cycles();
    if (all_strikes_ == 0 || !goals().empty()) return true;
    policy_.next = before;
    return false;
  }

  // Classes that answer, in which a foot comes down that does not in this one.
  std::vector<int> next_steps(int from) const {
    std::vector<int> steps;
    for (const int k : answering_) {
      if ((strikes_[from] & all_strikes_) == all_strikes_ || (strikes_[k] & ~strikes_[from]) != 0) steps.push_back(k);
    }
    return steps;
  }

  // Without a stand in between, if there is one.
  int best_of(const std::vector<int>& classes, int from) const {
    const auto is_better = [&](int a, int b) {
      const bool direct = bridge(from, a) < 0;
      if (direct != (bridge(from, b) < 0)) return direct;
      return quality_(from, a, control_) > quality_(from, b, control_);
    };
    return *std::min_element(classes.begin(), classes.end(), is_better);
  }

  bool is_answered(const std::vector<int>& cycle) {
    Vector2 sum = Vector2::Zero();
    double played = 0, speeds = 0, turns = 0;
    int strikes = 0;
    const auto play = [&](int k) {
      strikes |= strikes_[k];
      sum += Vector2(evident_[k].x, evident_[k].y), speeds += evident_[k].speed(), ++played;
      turns += std::abs(evident_[k].turn);
    };
    for (const int k : cycle) {
      play(k);
      if (bridge(k, next(k)) >= 0) play(bridge(k, next(k)));
    }
    const Control& wanted = space_.point(control_);
    if (wanted.speed() == 0) return space_.stands({speeds / played, 0, turns / played, 0});
    return (strikes & all_strikes_) == all_strikes_ && goes_along(sum.x() / played, sum.y() / played, wanted);
  }

  // Finds which classes lead to a cycle that answers, and those of the cycles that do not.
  void find_cycles() {
    constexpr char kUnknown = 2;
    leads_to_answer_.assign(quality_.classes, kUnknown);
    unanswered_.clear();
    for (int begin = 0; begin < quality_.classes; ++begin) {
      std::vector<int> way;
      int k = begin;
      while (leads_to_answer_[k] == kUnknown && std::find(way.begin(), way.end(), k) == way.end()) {
        way.push_back(k);
        k = next(k);
      }
      char answered = leads_to_answer_[k];
      if (answered == kUnknown) {
        const std::vector<int> cycle(std::find(way.begin(), way.end(), k), way.end());
        answered = is_answered(cycle) ? 1 : 0;
        if (answered == 0) unanswered_.insert(unanswered_.end(), cycle.begin(), cycle.end());
      }
      for (const int on_the_way : way) leads_to_answer_[on_the_way] = answered;
    }
  }

  Policy& policy_;
  const Quality& quality_;
  const ControlSpace& space_;
  const std::vector<Control>& evident_;
  const std::vector<int>& bridges_;
  const std::vector<int>& strikes_;
  int control_;
  int all_strikes_ = 0;  // of any class, where motion is asked for that can be stepped
  std::vector<int> answering_, unanswered_;
  std::vector<char> leads_to_answer_;
};

}  // namespace

std::vector<int> answered_controls(const Quality& quality, const ControlSpace& space,
                                   const std::vector<Control>& evident) {
  const int controls = space.size();
  std::vector<int> answered;
  for (int c = 0; c < controls; ++c) {
    const Control& wanted = space.point(c);
    if (asks_for_motion(wanted) && !answering_classes(quality, space, c, evident).empty()) answered.push_back(c);
  }
  std::vector<int> performed(controls);
  for (int c = 0; c < controls; ++c) {
    const auto nearer = [&](int a, int b) {
      return space.distance(space.point(a), space.point(c)) < space.distance(space.point(b), space.point(c));
    };
    const bool fails = asks_for_motion(space.point(c)) && !answered.empty();
    performed[c] = fails ? *std::min_element(answered.begin(), answered.end(), nearer) : c;
  }
  return performed;
}

void answer_motion(Policy& policy, const Quality& quality, const ControlSpace& space,
                   const std::vector<Control>& evident, const std::vector<int>& bridges,
                   const std::vector<int>& strikes) {
  for (int c = 0; c < policy.controls; ++c) {
    const Control& wanted = space.point(c);
    if (asks_for_motion(wanted) || asks_to_stand(wanted))
      HeldControl(policy, quality, space, evident, bridges, strikes, c).answer();
  }
  const std::vector<int> performed = answered_controls(quality, space, evident);
  for (std::size_t row = 0; row < policy.next.size(); row += policy.controls) {
    for (int c = 0; c < policy.controls; ++c) policy.next[row + c] = policy.next[row + performed[c]];
  }
}

}  // namespace fragmotion
