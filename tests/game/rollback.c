/* SPDX-License-Identifier: MIT */
/* How long a rollback takes: a state is restored, and eight frames are played again. Argument: a policy file. Prints
 * the least of many, in microseconds of the processor's time: of a stick that changes each half second. */
#include <fragmotion/fragmotion.h>
#include <stdio.h>
#include <stdlib.h>
#include <time.h>

#define FRAMES 8
#define TRIES 20
#define ROUNDS 60

static unsigned char policy[16 << 20], state[1 << 16];

static void succeed(FragmotionResult result) {
  if (result == FRAGMOTION_OK) return;
  fprintf(stderr, "%s\n", fragmotion_last_error());
  exit(1);
}

static void step(FragmotionPlayer* player, int frame) {
  FragmotionInput input = fragmotion_input();
  input.steer = FRAGMOTION_STEER_CAMERA;
  input.facing[2] = -1;
  input.move[0] = (float)(frame / 30 % 3 - 1);
  input.move[1] = (float)(frame / 30 % 5 - 2) / 2;
  succeed(fragmotion_player_step(player, &input, 1.0 / 60));
}

static double roll_back(FragmotionPlayer* player, size_t size, int frame) {
  const clock_t begin = clock();
  int i;
  succeed(fragmotion_player_restore(player, state, size));
  for (i = 0; i < FRAMES; ++i) step(player, frame + i);
  return 1e6 * (double)(clock() - begin) / CLOCKS_PER_SEC;
}

/* The least of some tries, of which other programs disturb the most. */
static double best(FragmotionPlayer* player, int frame) {
  size_t size = 0;
  double least = 1e9;
  int i;
  succeed(fragmotion_player_save(player, state, sizeof state, &size));
  for (i = 0; i < TRIES; ++i) {
    const double took = roll_back(player, size, frame);
    if (took < least) least = took;
  }
  return least;
}

int main(int count, char** arguments) {
  FragmotionCharacter* hero;
  FragmotionPlayer* player;
  FILE* file = count == 2 ? fopen(arguments[1], "rb") : NULL;
  double sum = 0;
  int round;
  if (file == NULL) return 2;
  succeed(fragmotion_character_load(policy, fread(policy, 1, sizeof policy, file), NULL, &hero));
  fclose(file);
  succeed(fragmotion_player_create(hero, NULL, &player));
  for (round = 0; round < ROUNDS; ++round) sum += best(player, FRAMES * round);
  printf("%.1f\n", sum / ROUNDS);
  fragmotion_player_release(player);
  fragmotion_character_release(hero);
  return 0;
}
