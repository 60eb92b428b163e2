/* SPDX-License-Identifier: MIT */
/* A game in C99: loads a policy file, plays ten seconds of a stick, and prints the sum of all poses. */
#include <stdio.h>
#include <stdlib.h>

#include <fragmotion/fragmotion.h>

#define BONES 256

static int failed(void) {
  fprintf(stderr, "%s\n", fragmotion_last_error());
  return 1;
}

static void* read_file(const char* path, size_t* size) {
  FILE* file = fopen(path, "rb");
  void* bytes = NULL;
  long length = 0;
  if (file == NULL) return NULL;
  if (fseek(file, 0, SEEK_END) == 0) length = ftell(file);
  rewind(file);
  if (length > 0) bytes = malloc((size_t)length);
  if (bytes != NULL) *size = fread(bytes, 1, (size_t)length, file);
  fclose(file);
  return bytes;
}

static uint64_t add(uint64_t hash, const void* data, size_t size) {
  const unsigned char* bytes = (const unsigned char*)data;
  size_t i;
  for (i = 0; i < size; ++i) hash = (hash ^ bytes[i]) * 1099511628211u;
  return hash;
}

int main(int count, char** arguments) {
  FragmotionLoadOptions options = fragmotion_load_options();
  FragmotionCharacter* hero = NULL;
  FragmotionPlayer* player = NULL;
  FragmotionCharacterInfo info = fragmotion_info();
  FragmotionTransform pose[BONES];
  uint64_t hash = 14695981039346656037u;
  size_t size = 0;
  int frame;
  void* bytes = count > 1 ? read_file(arguments[1], &size) : NULL;
  if (bytes == NULL) return 2;
  options.axes = FRAGMOTION_AXES_BLENDER;
  if (fragmotion_character_load(bytes, size, &options, &hero) != FRAGMOTION_OK) return failed();
  free(bytes);
  if (fragmotion_player_create(hero, NULL, &player) != FRAGMOTION_OK) return failed();
  if (fragmotion_character_info(hero, &info) != FRAGMOTION_OK || info.bones > BONES) return failed();
  for (frame = 0; frame < 600; ++frame) {
    FragmotionInput input = fragmotion_input();
    const int part = frame / 45;
    input.move[0] = (float)(part * 7 % 5 - 2);
    input.move[1] = (float)(part * 11 % 7 - 2);
    input.turn = (float)(part * 5 % 3 - 1);
    input.jump = part % 6 == 5;
    if (fragmotion_player_step(player, &input, 1.0f / 60) != FRAGMOTION_OK) return failed();
    if (fragmotion_player_pose(player, NULL, FRAGMOTION_SPACE_WORLD, pose, info.bones) != FRAGMOTION_OK) return failed();
    hash = add(hash, pose, (size_t)info.bones * sizeof pose[0]);
  }
  fragmotion_character_release(hero);
  fragmotion_player_release(player);
  printf("%016llx\n", (unsigned long long)hash);
  return 0;
}
