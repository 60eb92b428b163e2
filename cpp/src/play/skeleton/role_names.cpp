// SPDX-License-Identifier: MIT
#include "skeleton/role_names.hpp"

#include <stdexcept>

namespace fragmotion {

namespace {

int Roles::*find_role(const std::string& role) {
  std::string known;
  for (const auto& [name, member] : role_names()) {
    if (name == role) return member;
    known += (known.empty() ? "" : ", ") + name;
  }
  throw std::invalid_argument("no role '" + role + "'; the roles are " + known);
}

}  // namespace

const std::vector<std::pair<std::string, int Roles::*>>& role_names() {
  static const std::vector<std::pair<std::string, int Roles::*>> names = {
      {"hips", &Roles::hips},
      {"head", &Roles::head},
      {"left_hand", &Roles::left_hand},
      {"right_hand", &Roles::right_hand},
      {"left_foot", &Roles::left_foot},
      {"right_foot", &Roles::right_foot},
      {"left_toe", &Roles::left_toe},
      {"right_toe", &Roles::right_toe},
      {"left_thigh", &Roles::left_thigh},
      {"right_thigh", &Roles::right_thigh},
      {"left_fore_foot", &Roles::left_fore_foot},
      {"right_fore_foot", &Roles::right_fore_foot},
      {"left_fore_toe", &Roles::left_fore_toe},
      {"right_fore_toe", &Roles::right_fore_toe},
      {"left_fore_leg", &Roles::left_fore_leg},
      {"right_fore_leg", &Roles::right_fore_leg},
  };
  return names;
}

void assign_roles(const std::map<std::string, std::string>& bones, Skeleton& skeleton) {
  for (const auto& [role, bone] : bones) {
    const auto member = find_role(role);
    const int index = skeleton.find(bone);
    if (index < 0) throw std::invalid_argument("role '" + role + "': there is no bone '" + bone + "'");
    skeleton.roles.*member = index;
  }
}

std::map<std::string, std::string> named_roles(const Skeleton& skeleton) {
  std::map<std::string, std::string> named;
  for (const auto& [name, member] : role_names()) {
    const int bone = skeleton.roles.*member;
    if (bone >= 0) named[name] = skeleton.names[bone];
  }
  return named;
}

}  // namespace fragmotion
