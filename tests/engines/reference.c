/* SPDX-License-Identifier: MIT */
/* What an engine's poses are compared with: plays FRAMES frames of a stick on a policy, and prints for each 10th frame
 * and each bone "frame name x y z qx qy qz qw" in model space, then "frame place x y z heading". */
#include <stdio.h>
#include <stdlib.h>

#include <fragmotion/fragmotion.h>

#define BONES 256

static void demand(int holds) {
  if (holds) return;
  fprintf(stderr, "%s\n", fragmotion_last_error());
  exit(1);
}

static void print_pose(const FragmotionCharacter* hero, const FragmotionPlayer* player, int bones, int frame) {
  FragmotionTransform pose[BONES];
  FragmotionState state = fragmotion_state();
  int i;
  demand(fragmotion_player_pose(player, NULL, FRAGMOTION_SPACE_MODEL, pose, bones) == FRAGMOTION_OK);
  for (i = 0; i < bones; ++i) {
    const float *at = pose[i].position, *turned = pose[i].rotation;
    FragmotionBone bone = fragmotion_bone();
    demand(fragmotion_character_bone(hero, i, &bone) == FRAGMOTION_OK);
    printf("%d %s %.9g %.9g %.9g %.9g %.9g %.9g %.9g\n", frame, bone.name, at[0], at[1], at[2], turned[0], turned[1],
           turned[2], turned[3]);
  }
  demand(fragmotion_player_state(player, &state) == FRAGMOTION_OK);
  printf("%d place %.9g %.9g %.9g %.9g\n", frame, state.place.position[0], state.place.position[1],
         state.place.position[2], state.place.heading);
}

int main(int count, char** arguments) {
  static char bytes[1 << 26];
  FragmotionCharacter* hero = NULL;
  FragmotionPlayer* player = NULL;
  FragmotionCharacterInfo info = fragmotion_info();
  FILE* file = count == 3 ? fopen(arguments[1], "rb") : NULL;
  size_t size;
  int frame, frames;
  if (file == NULL) return 2;
  size = fread(bytes, 1, sizeof bytes, file);
  fclose(file);
  frames = atoi(arguments[2]);
  demand(fragmotion_character_load(bytes, size, NULL, &hero) == FRAGMOTION_OK);
  demand(fragmotion_character_info(hero, &info) == FRAGMOTION_OK && info.bones <= BONES);
  demand(fragmotion_player_create(hero, NULL, &player) == FRAGMOTION_OK);
  for (frame = 1; frame <= frames; ++frame) {
    FragmotionInput input = fragmotion_input();
    const int part = frame / 40;
    input.steer = FRAGMOTION_STEER_CAMERA;
    input.move[0] = (float)(part * 7 % 5 - 2) / 4;
    input.move[1] = (float)(part * 11 % 5 - 1) / 4;
    input.facing[2] = -1;
    input.jump = part % 5 == 3;
    demand(fragmotion_player_step(player, &input, 1.0 / 60) == FRAGMOTION_OK);
    if (frame % 10 == 0) print_pose(hero, player, info.bones, frame);
  }
  return 0;
}
