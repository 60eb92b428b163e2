/* SPDX-License-Identifier: MIT */
/* Ten minutes of a wild stick with moves, styles and stairs, the same on every machine:
 *     wild_game play POLICY STATE      prints the sums of all poses of the two halves, and saves the state between them
 *     wild_game replay POLICY STATE    goes on from that state, which another machine may have saved
 * All numbers of its own are exact, so that what differs is the library's. */
#include <fragmotion/fragmotion.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define MOST_BONES 256
#define MOST_STATE 65536
#define HALF (5 * 60 * 60) /* frames */

typedef struct Game {
  FragmotionPlayer* player;
  FragmotionCharacterInfo info;
  uint64_t random, hash;
  FragmotionInput input;
  int32_t frames_left; /* of this input */
} Game;

static void demand(int is_met) {
  if (is_met) return;
  fprintf(stderr, "%s\n", fragmotion_last_error());
  exit(1);
}

static void succeed(FragmotionResult result) { demand(result == FRAGMOTION_OK); }

static size_t read_file(const char* path, void* bytes, size_t capacity) {
  size_t size = 0;
  FILE* file = fopen(path, "rb");
  demand(file != NULL);
  size = fread(bytes, 1, capacity, file);
  fclose(file);
  return size;
}

static void write_file(const char* path, const void* bytes, size_t size) {
  FILE* file = fopen(path, "wb");
  demand(file != NULL && fwrite(bytes, 1, size, file) == size && fclose(file) == 0);
}

/* 0 .. below - 1. */
static int32_t draw(Game* game, int32_t below) {
  game->random = game->random * 6364136223846793005u + 1442695040888963407u;
  return (int32_t)((game->random >> 33) % (uint64_t)below);
}

/* Stairs up and down again for ever, of 17 cm and 30 cm, along both axes. */
static int32_t stairs(void* user, const float from[3], FragmotionGroundHit* hit) {
  const double step = floor((double)from[0] * 0.125) + floor((double)from[1] * 3.25);
  const double around = step - 24 * floor(step / 24);
  (void)user;
  hit->height = (float)((around < 12 ? around : 24 - around) * 0.171875);
  hit->normal[0] = hit->normal[1] = 0;
  hit->normal[2] = 1;
  return 1;
}

static void push_stick(Game* game) {
  FragmotionInput* input = &game->input;
  const int32_t by_camera = draw(game, 2);
  int axis;
  *input = fragmotion_input();
  input->steer = by_camera ? FRAGMOTION_STEER_CAMERA : FRAGMOTION_STEER_CHARACTER;
  for (axis = 0; axis < 2; ++axis) {
    const float pushed = (float)(draw(game, 17) - 8) / 8;
    input->move[axis] = by_camera ? pushed : 4 * pushed;
    input->facing[axis] = by_camera ? (float)(draw(game, 17) - 8) : 0;
  }
  input->turn = draw(game, 3) == 0 ? (float)(draw(game, 3) - 1) : 0;
  input->jump = draw(game, 6) == 0;
  game->frames_left = 4 + draw(game, 90);
}

static void press_buttons(Game* game) {
  if (game->info.moves > 0 && draw(game, 150) == 0) {
    succeed(fragmotion_player_start_move(game->player, draw(game, game->info.moves)));
  }
  if (game->info.moves > 0 && draw(game, 100) == 0) {
    succeed(fragmotion_player_release_move(game->player, draw(game, game->info.moves)));
  }
  if (game->info.styles > 1 && draw(game, 200) == 0) {
    succeed(fragmotion_player_change_style(game->player, draw(game, game->info.styles)));
  }
}

static void step(Game* game) { succeed(fragmotion_player_step(game->player, &game->input, 1.0 / 60)); }

static size_t save(Game* game, unsigned char* state) {
  size_t size = 0;
  succeed(fragmotion_player_save(game->player, state, MOST_STATE, &size));
  return size;
}

/* As games do whose other players' sticks come late: eight frames are guessed, taken back and played again. */
static void roll_back(Game* game) {
  static unsigned char state[MOST_STATE];
  const size_t size = save(game, state);
  int frame;
  for (frame = 0; frame < 8; ++frame) step(game);
  succeed(fragmotion_player_restore(game->player, state, size));
}

static void add_pose(Game* game) {
  FragmotionTransform pose[MOST_BONES];
  const unsigned char* bytes = (const unsigned char*)pose;
  const size_t size = (size_t)game->info.bones * sizeof pose[0];
  size_t i;
  succeed(fragmotion_player_pose(game->player, NULL, FRAGMOTION_SPACE_WORLD, pose, game->info.bones));
  for (i = 0; i < size; ++i) game->hash = (game->hash ^ bytes[i]) * 1099511628211u;
}

static void play_half(Game* game, uint64_t seed) {
  int frame;
  game->random = seed;
  game->hash = 14695981039346656037u;
  game->frames_left = 0;
  for (frame = 0; frame < HALF; ++frame) {
    if (game->frames_left-- == 0) push_stick(game);
    press_buttons(game);
    if (frame % 200 == 0) roll_back(game);
    step(game);
    add_pose(game);
  }
  printf("%016llx\n", (unsigned long long)game->hash);
}

static FragmotionCharacter* load(const char* path) {
  static unsigned char bytes[64 << 20];
  FragmotionLoadOptions options = fragmotion_load_options();
  FragmotionCharacter* hero = NULL;
  options.axes = FRAGMOTION_AXES_BLENDER;
  succeed(fragmotion_character_load(bytes, read_file(path, bytes, sizeof bytes), &options, &hero));
  return hero;
}

int main(int count, char** arguments) {
  static unsigned char state[MOST_STATE];
  FragmotionCharacter* hero;
  Game game;
  if (count != 4) return 2;
  hero = load(arguments[2]);
  memset(&game, 0, sizeof game);
  game.info = fragmotion_info();
  succeed(fragmotion_character_info(hero, &game.info));
  demand(game.info.bones <= MOST_BONES);
  succeed(fragmotion_player_create(hero, NULL, &game.player));
  succeed(fragmotion_player_set_ground(game.player, stairs, NULL));
  if (strcmp(arguments[1], "replay") == 0) {
    succeed(fragmotion_player_restore(game.player, state, read_file(arguments[3], state, sizeof state)));
  } else {
    play_half(&game, 1);
    write_file(arguments[3], state, save(&game, state));
  }
  play_half(&game, 2);
  fragmotion_player_release(game.player);
  fragmotion_character_release(hero);
  return 0;
}
