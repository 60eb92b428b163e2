// SPDX-License-Identifier: MIT
//
// A small game: two characters on a split screen, each seen by its own machine, over a bad line; two hundred others who
// walk round. Arguments: A.policy A.glb [B.policy [B.glb]] [--script FRAMES PICTURE]. Without a mesh a character is its
// bones. Pads, or WASD and Q, E, space; arrows and comma, full stop, right control.
#include <raylib.h>
#include <raymath.h>
#include <rlgl.h>

#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <string>

#include "rollback.hpp"

namespace fm = fragmotion::game;
using rollback::Machine;
using rollback::Stick;

static constexpr int kOthers = 200, kWidth = 1280, kHeight = 640, kCells = 100;
static constexpr float kField = 80;    // m, the side of the ground
static constexpr float kRoom = 0.35F;  // m around each of the others
static constexpr const char* kVertex = R"(#version 330
in vec3 vertexPosition; in vec3 vertexNormal; in vec2 vertexTexCoord; in mat4 instanceTransform;
uniform mat4 mvp; out vec3 normal; out vec2 uv;
void main() {
  normal = mat3(instanceTransform) * vertexNormal; uv = vertexTexCoord;
  gl_Position = mvp * instanceTransform * vec4(vertexPosition, 1.0);
})";
static constexpr const char* kFragment = R"(#version 330
in vec3 normal; in vec2 uv; uniform sampler2D texture0; uniform vec4 colDiffuse; out vec4 color;
void main() {
  float light = 0.45 + 0.55 * max(dot(normalize(normal), normalize(vec3(0.4, 1.0, 0.5))), 0.0);
  color = vec4(light * (texture(texture0, uv) * colDiffuse).rgb, 1.0);
})";

[[noreturn]] static void fail(const std::string& what) {
  std::fprintf(stderr, "%s\n", what.c_str());
  std::exit(1);
}

// ---- the ground -----------------------------------------------------------------------------------------------------

static float height_at(float x, float z) { return 0.7F * std::sin(0.23F * x) * std::sin(0.2F * z); }

static std::int32_t ground(void* /*user*/, const float from[3], FragmotionGroundHit* hit) {
  const float x = from[0], z = from[2];
  *hit = {height_at(x, z),
          {-0.161F * std::cos(0.23F * x) * std::sin(0.2F * z), 1, -0.14F * std::sin(0.23F * x) * std::cos(0.2F * z)}};
  return 1;
}

static Mesh ground_mesh() {
  Mesh mesh = GenMeshPlane(kField, kField, kCells, kCells);
  for (int i = 0; i < mesh.vertexCount; ++i) {
    float* vertex = mesh.vertices + 3 * i;
    FragmotionGroundHit hit;
    ground(nullptr, vertex, &hit);
    vertex[1] = hit.height;
    std::copy(hit.normal, hit.normal + 3, mesh.normals + 3 * i);
  }
  UpdateMeshBuffer(mesh, 0, mesh.vertices, 12 * mesh.vertexCount, 0);
  UpdateMeshBuffer(mesh, 2, mesh.normals, 12 * mesh.vertexCount, 0);
  return mesh;
}

// ---- what is drawn --------------------------------------------------------------------------------------------------

struct Look {
  Shader shader = LoadShaderFromMemory(kVertex, kFragment);
  Mesh bone = GenMeshCylinder(1, 1, 6);

  Look() {
    shader.locs[SHADER_LOC_MATRIX_MVP] = GetShaderLocation(shader, "mvp");
    shader.locs[SHADER_LOC_VERTEX_INSTANCETRANSFORM] = GetShaderLocationAttrib(shader, "instanceTransform");
  }
  Material material(Color color) const {
    Material made = LoadMaterialDefault();
    made.shader = shader;
    made.maps[MATERIAL_MAP_DIFFUSE].color = color;
    return made;
  }
};

/// A policy and, if there is one, the mesh that it moves.
class Hero {
 public:
  Hero(const char* policy, const char* glb) {
    int size = 0;
    unsigned char* bytes = LoadFileData(policy, &size);
    character = fm::Character::load(bytes, static_cast<std::size_t>(size));
    UnloadFileData(bytes);
    if (!character) fail(std::string(policy) + ": " + fm::last_error());
    for (int i = 0; i < character.info().bones; ++i) bones_.push_back(character.bone(i));
    ends_.assign(bones_.size(), true);
    for (const FragmotionBone& bone : bones_) {
      if (bone.parent >= 0) ends_[static_cast<std::size_t>(bone.parent)] = false;
    }
    pose_.resize(bones_.size());
    if (glb != nullptr) bind(glb);
  }

  /// Bones as cylinders from their parents' heads to their own, those at the ends as long again as they are.
  void add_bones(const fm::PlayerRef& player, std::vector<Matrix>& drawn) {
    player.pose(FRAGMOTION_SPACE_WORLD, pose_.data(), static_cast<std::int32_t>(pose_.size()));
    const auto head = [&](std::size_t bone) {
      const float* at = pose_[bone].position;
      return Vector3{at[0], at[1], at[2]};
    };
    for (std::size_t i = 0; i < pose_.size(); ++i) {
      const std::int32_t parent = bones_[i].parent;
      if (parent < 0 || static_cast<int>(i) == character.info().hips) continue;
      const Vector3 from = head(static_cast<std::size_t>(parent)), along = Vector3Subtract(head(i), from);
      const float apart = Vector3Length(along), length = apart + (ends_[i] ? bones_[i].length : 0);
      if (apart < 0.01F) continue;
      const float thick = 0.16F * std::min(length, 0.45F) + 0.015F;
      const Matrix turn = QuaternionToMatrix(QuaternionFromVector3ToVector3({0, 1, 0}, Vector3Normalize(along)));
      const Matrix shape = MatrixMultiply(MatrixScale(thick, length, thick), turn);
      drawn.push_back(MatrixMultiply(shape, MatrixTranslate(from.x, from.y, from.z)));
    }
  }

  void draw(const fm::PlayerRef& player, const Look& look, Color color) {
    if (model_.meshCount == 0) {
      std::vector<Matrix> drawn;
      add_bones(player, drawn);
      DrawMeshInstanced(look.bone, look.material(color), drawn.data(), static_cast<int>(drawn.size()));
      return;
    }
    player.skinning(rig_, FRAGMOTION_SPACE_WORLD, matrices_.data(), static_cast<std::int32_t>(matrices_.size() / 16));
    const Matrix none = MatrixIdentity();
    for (int i = 0; i < model_.meshCount; ++i) {
      skin(model_.meshes[i]);
      Material& material = model_.materials[model_.meshMaterial[i]];
      material.shader = look.shader;
      DrawMeshInstanced(model_.meshes[i], material, &none, 1);
    }
  }

  fm::Character character;

 private:
  void bind(const char* glb) {
    model_ = LoadModel(glb);
    const int count = model_.skeleton.boneCount;
    if (count == 0) fail(std::string(glb) + ": no mesh with a skeleton");
    std::vector<const char*> names;
    std::vector<float> inverses;
    for (int i = 0; i < count; ++i) {
      const Transform& rest = model_.skeleton.bindPose[i];
      const Matrix bound = MatrixMultiply(QuaternionToMatrix(rest.rotation),
                                          MatrixTranslate(rest.translation.x, rest.translation.y, rest.translation.z));
      const float16 numbers = MatrixToFloatV(MatrixInvert(bound));
      names.push_back(model_.skeleton.bones[i].name);
      inverses.insert(inverses.end(), numbers.v, numbers.v + 16);
    }
    FragmotionRigOptions options = fragmotion_rig_options();
    options.bones = count;
    options.names = names.data();
    options.inverse_binds = inverses.data();
    rig_ = fm::Rig(character, options);
    if (!rig_) fail(std::string(glb) + ": " + fm::last_error());
    matrices_.assign(16 * static_cast<std::size_t>(count), 0);
  }

  void skin(Mesh& mesh) {
    points_.assign(3 * static_cast<std::size_t>(mesh.vertexCount), 0);
    normals_.assign(points_.size(), 0);
    for (int vertex = 0; vertex < mesh.vertexCount; ++vertex) {
      const float *point = mesh.vertices + 3 * vertex, *normal = mesh.normals + 3 * vertex;
      for (int k = 4 * vertex; k < 4 * vertex + 4; ++k) {
        const float weight = mesh.boneWeights[k];
        if (weight == 0) continue;
        const float* m = &matrices_[16 * static_cast<std::size_t>(mesh.boneIndices[k])];
        for (int row = 0; row < 3; ++row) {
          const auto to = static_cast<std::size_t>(3 * vertex + row);
          points_[to] += weight * (m[row] * point[0] + m[4 + row] * point[1] + m[8 + row] * point[2] + m[12 + row]);
          normals_[to] += weight * (m[row] * normal[0] + m[4 + row] * normal[1] + m[8 + row] * normal[2]);
        }
      }
    }
    const int size = static_cast<int>(points_.size() * sizeof(float));
    UpdateMeshBuffer(mesh, 0, points_.data(), size, 0);
    UpdateMeshBuffer(mesh, 2, normals_.data(), size, 0);
  }

  std::vector<FragmotionBone> bones_;
  std::vector<bool> ends_;
  std::vector<fm::Transform> pose_;
  Model model_{};
  fm::Rig rig_;
  std::vector<float> matrices_, points_, normals_;
};

/// Those who walk round, each along a circle of its own.
class Others {
 public:
  explicit Others(const fm::Character& character)
      : crowd_(character, kOthers), inputs_(static_cast<std::size_t>(kOthers), fm::by_path()) {
    for (int i = 0; i < kOthers; ++i) {
      const float centre[] = {16.0F * static_cast<float>(i % 5 - 2), 16.0F * static_cast<float>(i / 5 % 5 - 2)};
      float points[24][3];
      for (int k = 0; k < 24; ++k) {
        const float angle = 0.2618F * static_cast<float>(k) + static_cast<float>(i / 25) * 0.785F;
        const float radius = 5 + 0.35F * static_cast<float>(i / 25);
        points[k][0] = centre[0] + radius * std::cos(angle);
        points[k][1] = 0;
        points[k][2] = centre[1] + radius * std::sin(angle);
      }
      FragmotionPath path = fragmotion_path();
      path.points = 24;
      path.positions = points[0];
      path.closed = 1;
      path.end = FRAGMOTION_PATH_LOOP;
      crowd_[i].set_ground(&ground, nullptr);
      crowd_[i].reset({{points[0][0], height_at(points[0][0], points[0][2]), points[0][2]}, 0});
      if (!crowd_[i].set_path(path)) fail(fm::last_error());
    }
  }
  /// They keep clear of each other, and of the players.
  void step(const FragmotionBody (&players)[2]) {
    crowd_.make_way(kRoom, rollback::kFrame, players, 2);
    crowd_.step(inputs_.data(), rollback::kFrame);
  }
  /// How near two of them, or one and a player, have come.
  float nearest(const FragmotionBody (&players)[2]) const {
    std::vector<Vector2> places;
    for (const FragmotionBody& player : players) places.push_back({player.position[0], player.position[2]});
    for (int i = 0; i < kOthers; ++i) {
      const FragmotionPlace place = crowd_[i].state().place;
      places.push_back({place.position[0], place.position[2]});
    }
    float least = kField;
    for (std::size_t i = 2; i < places.size(); ++i) {
      for (std::size_t k = 0; k < i; ++k) least = std::min(least, Vector2Distance(places[i], places[k]));
    }
    return least;
  }
  void add_bones(Hero& hero, std::vector<Matrix>& drawn) const {
    for (int i = 0; i < kOthers; ++i) hero.add_bones(crowd_[i], drawn);
  }

 private:
  fm::Crowd crowd_;
  std::vector<fm::Input> inputs_;
};

// ---- the sticks -----------------------------------------------------------------------------------------------------

static std::int8_t level(float value) { return static_cast<std::int8_t>(127 * std::clamp(value, -1.0F, 1.0F)); }
static float keys(int less, int more) {
  return static_cast<float>(IsKeyDown(more)) - static_cast<float>(IsKeyDown(less));
}

static Stick read_stick(int pad, float& yaw) {
  static constexpr int kKeys[2][7] = {
      {KEY_A, KEY_D, KEY_S, KEY_W, KEY_Q, KEY_E, KEY_SPACE},
      {KEY_LEFT, KEY_RIGHT, KEY_DOWN, KEY_UP, KEY_COMMA, KEY_PERIOD, KEY_RIGHT_CONTROL}};
  const int* key = kKeys[pad];
  const auto axis = [&](int which) { return IsGamepadAvailable(pad) ? GetGamepadAxisMovement(pad, which) : 0; };
  yaw -= 0.04F * (axis(GAMEPAD_AXIS_RIGHT_X) + keys(key[4], key[5]));
  yaw = std::remainder(yaw, 2 * PI);
  const bool jumps = IsKeyDown(key[6]) || IsGamepadButtonDown(pad, GAMEPAD_BUTTON_RIGHT_FACE_DOWN);
  return {level(axis(GAMEPAD_AXIS_LEFT_X) + keys(key[0], key[1])),
          level(keys(key[2], key[3]) - axis(GAMEPAD_AXIS_LEFT_Y)), static_cast<std::int8_t>(yaw / 0.0245437F),
          static_cast<std::uint8_t>(jumps)};
}

/// What is played without hands: both change their minds each second or so, and jump now and then.
static Stick scripted(int pad, int frame) {
  const int part = frame / (50 + 17 * pad);
  const auto right = static_cast<float>((part * 7 + pad) % 5 - 2) / 2,
             up = static_cast<float>((part * 3 + 2 * pad) % 4) / 3;
  const float length = std::max(1.0F, std::hypot(right, up));
  return {level(right / length), level(up / length), 0, static_cast<std::uint8_t>(part % 4 == 3)};
}

// ---- the game -------------------------------------------------------------------------------------------------------

struct Arguments {
  std::vector<const char*> files;
  int frames = 0;  // of a scripted game; 0: played by hand
  const char* picture = nullptr;

  Arguments(int count, char** words) {
    for (int i = 1; i < count; ++i) {
      if (std::string(words[i]) == "--script" && i + 2 < count) {
        frames = std::atoi(words[++i]);
        picture = words[++i];
      } else {
        files.push_back(words[i]);
      }
    }
    if (files.empty() || files.size() > 4)
      fail("usage: game A.policy A.glb [B.policy [B.glb]] [--script FRAMES PICTURE]");
  }
  const char* file(std::size_t index) const { return index < files.size() ? files[index] : nullptr; }
};

static fm::Player player_of(const Hero& hero, int index) {
  fm::Player player(hero.character);
  const float x = index == 0 ? -1.0F : 1.0F;
  if (!player.set_ground(&ground, nullptr) || !player.reset({{x, height_at(x, 0), 0}, 0})) fail(fm::last_error());
  return player;
}

static FragmotionBody body_of(const fm::PlayerRef& player) {
  const FragmotionState state = player.state();
  FragmotionBody body{{}, {}, kRoom};
  std::copy(state.place.position, state.place.position + 3, body.position);
  std::copy(state.velocity, state.velocity + 3, body.velocity);
  return body;
}

static Camera3D camera_behind(const FragmotionPlace& place, float yaw) {
  const Vector3 at{place.position[0], place.position[1] + 1.2F, place.position[2]};
  return {Vector3Add(at, {4.5F * std::sin(yaw), 1.2F, 4.5F * std::cos(yaw)}), at, {0, 1, 0}, 50, CAMERA_PERSPECTIVE};
}

int main(int count, char** words) {
  const Arguments given(count, words);
  SetTraceLogLevel(LOG_WARNING);
  SetConfigFlags(FLAG_MSAA_4X_HINT | FLAG_VSYNC_HINT);
  InitWindow(kWidth, kHeight, "Fragmotion");
  SetTargetFPS(given.frames > 0 ? 0 : 60);
  const Look look;
  Hero first(given.file(0), given.file(1));
  Hero second(given.file(2) != nullptr ? given.file(2) : given.file(0),
              given.file(2) != nullptr ? given.file(3) : given.file(1));
  Hero* const heroes[] = {&first, &second};
  Others others(first.character);
  Machine machines[] = {{0, player_of(first, 0), player_of(second, 1)}, {1, player_of(first, 0), player_of(second, 1)}};
  rollback::Line lines[] = {rollback::Line(1), rollback::Line(2)};
  rollback::Umpire umpire;

  const Mesh field = ground_mesh();
  Material grass = look.material(WHITE);
  grass.maps[MATERIAL_MAP_DIFFUSE].texture =
      LoadTextureFromImage(GenImageChecked(640, 640, 8, 8, {96, 118, 96, 255}, {110, 134, 108, 255}));
  const Material crowd_color = look.material({150, 160, 190, 255});
  const Color colors[] = {{230, 160, 70, 255}, {90, 190, 210, 255}};
  RenderTexture2D views[] = {LoadRenderTexture(kWidth / 2, kHeight), LoadRenderTexture(kWidth / 2, kHeight)};
  float yaws[2] = {0, 0};
  std::vector<Matrix> drawn;
  float nearest = kField;

  for (int now = 0; !WindowShouldClose() && (given.frames == 0 || now < given.frames); ++now) {
    for (int i = 0; i < 2; ++i) {
      const Stick stick = given.frames > 0 ? scripted(i, now) : read_stick(i, yaws[i]);
      machines[i].advance(stick, lines[i], lines[1 - i], now);
    }
    umpire.compare(machines[0], machines[1]);
    const FragmotionBody bodies[] = {body_of(machines[0].player(0)), body_of(machines[0].player(1))};
    others.step(bodies);
    nearest = std::min(nearest, others.nearest(bodies));

    drawn.clear();
    others.add_bones(first, drawn);
    const Matrix none = MatrixIdentity();
    for (int i = 0; i < 2; ++i) {
      BeginTextureMode(views[i]);
      ClearBackground({190, 208, 226, 255});
      BeginMode3D(camera_behind(machines[i].player(i).state().place, yaws[i]));
      DrawMeshInstanced(field, grass, &none, 1);
      DrawMeshInstanced(look.bone, crowd_color, drawn.data(), static_cast<int>(drawn.size()));
      for (int k = 0; k < 2; ++k) heroes[k]->draw(machines[i].player(k), look, colors[k]);
      EndMode3D();
      EndTextureMode();
    }
    BeginDrawing();
    for (int i = 0; i < 2; ++i) {
      const float left = static_cast<float>(i) * kWidth / 2;
      DrawTextureRec(views[i].texture, {0, 0, kWidth / 2, -static_cast<float>(kHeight)}, {left, 0}, WHITE);
      DrawText(TextFormat("machine %d  frame %d, agreed to %d\nrollbacks %d, by %d frames at most", i + 1,
                          machines[i].frame(), machines[i].agreed(), machines[i].rollbacks, machines[i].longest),
               static_cast<int>(left) + 12, 10, 20, BLACK);
    }
    DrawRectangle(kWidth / 2 - 1, 0, 2, kHeight, BLACK);
    DrawRectangle(0, kHeight - 36, kWidth, 36, {20, 24, 28, 255});
    DrawText(TextFormat("100 ms, 5 %% lost   checksum %016llx   equal %d, unequal %d",
                        static_cast<unsigned long long>(umpire.last), umpire.equal, umpire.unequal),
             12, kHeight - 28, 20, umpire.unequal == 0 ? GREEN : RED);
    if (now + 1 == given.frames) {
      rlDrawRenderBatchActive();
      ExportImage(LoadImageFromScreen(), given.picture);
    }
    EndDrawing();
  }
  std::printf("frames %d and %d, rollbacks %d and %d by %d at most, equal %d, unequal %d\n", machines[0].frame(),
              machines[1].frame(), machines[0].rollbacks, machines[1].rollbacks,
              std::max(machines[0].longest, machines[1].longest), umpire.equal, umpire.unequal);
  std::printf("nobody nearer than %.2f m\n", static_cast<double>(nearest));
  CloseWindow();
  return umpire.unequal == 0 ? 0 : 1;
}
