/* SPDX-License-Identifier: MIT */
/*
 * Fragmotion for games: a character that was made in Blender, a .policy file, as poses that follow a stick.
 *
 *     FragmotionCharacter* hero;    // what the file holds: never changes, shared by all who play it
 *     FragmotionPlayer* player;     // one who plays it
 *     fragmotion_character_load(bytes, size, &load_options, &hero);
 *     fragmotion_player_create(hero, NULL, &player);
 *     for (;;) {                                                        // each frame of the game
 *       fragmotion_player_step(player, &input, seconds);
 *       fragmotion_player_state(player, &state);                        // state.place: where to draw it
 *       fragmotion_player_skinning(player, rig, FRAGMOTION_SPACE_MODEL, matrices, bones);
 *     }
 *
 * docs/game.md is the way from a .policy to a walking mesh in ten minutes. In C++, fragmotion.hpp wraps this.
 *
 * Results: every function that can fail returns a FragmotionResult. What was wrong, in words, is
 * fragmotion_last_error() of the same thread. A call that fails changes nothing, and writes nothing but where it says
 * so.
 *
 * Axes are chosen once, as the character is loaded (FragmotionAxes, units_per_metre): all that goes in and comes out is
 * in the engine's axes, handedness and unit. Angles are in radians, time is in seconds.
 *
 * Headings are the engine's own yaw: about its up axis, by its hand's rule; 0 faces the character's forward axis. Those
 * that come out are within half a turn to either side.
 *
 * Rotations are unit quaternions x, y, z, w. Matrices are 4 x 4, column by column, and for column vectors.
 *
 * Structs that may grow begin with their size: make them with the function of their name, as in
 * FragmotionInput input = fragmotion_input();
 *
 * Memory: stepping, posing, saving, restoring, blending and asking for the state allocate nothing; what loads, creates,
 * sets, finds, describes and releases may, and so may the words of an error. What you create you release; a character,
 * in any order with its players.
 *
 * Threads: there are none inside, and nothing global but the words of each thread's last error and the list of what is
 * alive. A character and a rig may be used by any number of threads at the same time; a player, and a part of a crowd,
 * by one at a time.
 *
 * Same bits: the same file, seed, options and calls give the same poses, whatever else the program does.
 */
#ifndef FRAGMOTION_FRAGMOTION_H
#define FRAGMOTION_FRAGMOTION_H

/* NOLINTBEGIN(modernize-*): this is C */
#include <stddef.h>
#include <stdint.h>

#define FRAGMOTION_VERSION_MAJOR 0
#define FRAGMOTION_VERSION_MINOR 1
#define FRAGMOTION_VERSION_PATCH 0
#define FRAGMOTION_VERSION_STRING "0.1.0"

#if defined(_WIN32) && defined(FRAGMOTION_BUILDS_SHARED)
#define FRAGMOTION_EXPORT __declspec(dllexport)
#elif defined(_WIN32) && defined(FRAGMOTION_SHARED)
#define FRAGMOTION_EXPORT __declspec(dllimport)
#elif defined(__GNUC__)
#define FRAGMOTION_EXPORT __attribute__((visibility("default")))
#else
#define FRAGMOTION_EXPORT
#endif

#ifdef __cplusplus
#define FRAGMOTION_NOEXCEPT noexcept
extern "C" {
#else
#define FRAGMOTION_NOEXCEPT
#endif

/* What a policy file holds. */
typedef struct FragmotionCharacter FragmotionCharacter;
/* The bones of a mesh as the game has them: their order, and what they are bound by. */
typedef struct FragmotionRig FragmotionRig;
/* One that plays a character. */
typedef struct FragmotionPlayer FragmotionPlayer;
/* Many that play a character, in parts for the game's jobs. */
typedef struct FragmotionCrowd FragmotionCrowd;

typedef enum FragmotionResult {
  FRAGMOTION_OK = 0,
  FRAGMOTION_ERROR_ARGUMENT = 1,      /* null, out of range, not a number */
  FRAGMOTION_ERROR_SIZE = 2,          /* a struct's size is none that this library knows */
  FRAGMOTION_ERROR_CAPACITY = 3,      /* there is not room enough for what is to be written */
  FRAGMOTION_ERROR_HANDLE = 4,        /* released, or never made (fragmotion_check_handles) */
  FRAGMOTION_ERROR_REFUSED = 5,       /* the bytes are no policy or no state, cut short, damaged or inconsistent */
  FRAGMOTION_ERROR_NEWER_VERSION = 6, /* the bytes are of a newer Fragmotion */
  FRAGMOTION_ERROR_OLDER_VERSION = 7, /* the bytes are of a Fragmotion that is too old: build the policy again */
  FRAGMOTION_ERROR_MEMORY = 8,        /* the system has no memory left */
  FRAGMOTION_ERROR_INTERNAL = 9       /* a bug of the library's; please report what fragmotion_last_error() says */
} FragmotionResult;

/* How an engine's axes lie. A character at heading 0 faces forward. Rotations of bones are those that the engine's own
 * importer gives to the mesh that Blender exports with the armature (docs/game.md). */
typedef int32_t FragmotionAxes;
enum {
  FRAGMOTION_AXES_BLENDER = 0, /* right-handed: x right, y forward, z up */
  FRAGMOTION_AXES_GLTF = 1,    /* right-handed: x right, y up, -z forward; also Godot's, three.js's, OpenGL's */
  FRAGMOTION_AXES_UNITY = 2,   /* left-handed: x right, y up, z forward; bones as glTFast and Unity's FBX importer do */
  FRAGMOTION_AXES_UNREAL = 3   /* left-handed: x forward, y right, z up; bones as Unreal's FBX importer does */
};

typedef int32_t FragmotionSpace;
enum {
  FRAGMOTION_SPACE_LOCAL = 0, /* of each bone in its parent; of the one without a parent, as in model space */
  FRAGMOTION_SPACE_MODEL = 1, /* as seen from where the character stands and faces: FragmotionState.place */
  FRAGMOTION_SPACE_WORLD = 2
};

/* What a bone is to the body. */
typedef enum FragmotionRole {
  FRAGMOTION_ROLE_NONE = 0,
  FRAGMOTION_ROLE_HIPS = 1,
  FRAGMOTION_ROLE_HEAD = 2,
  FRAGMOTION_ROLE_LEFT_HAND = 3,
  FRAGMOTION_ROLE_RIGHT_HAND = 4,
  FRAGMOTION_ROLE_LEFT_FOOT = 5,
  FRAGMOTION_ROLE_RIGHT_FOOT = 6,
  FRAGMOTION_ROLE_LEFT_TOE = 7,
  FRAGMOTION_ROLE_RIGHT_TOE = 8,
  FRAGMOTION_ROLE_LEFT_THIGH = 9,
  FRAGMOTION_ROLE_RIGHT_THIGH = 10
} FragmotionRole;

/* A bone's place and rotation. */
typedef struct FragmotionTransform {
  float position[3];
  float rotation[4]; /* x, y, z, w */
} FragmotionTransform;

/* Where a character stands, on the ground below its hips, and where it faces. */
typedef struct FragmotionPlace {
  float position[3];
  float heading;
} FragmotionPlace;

/* ---- the library ------------------------------------------------------------------------------------------------ */

/* "0.1.0". */
FRAGMOTION_EXPORT const char* fragmotion_version(void) FRAGMOTION_NOEXCEPT;

/* What was wrong in the last call of this thread that failed: which function, what, and what to do. Valid until the
 * next one that fails; "" before the first. Never null. */
FRAGMOTION_EXPORT const char* fragmotion_last_error(void) FRAGMOTION_NOEXCEPT;

/* A result in a word or two: "wrong argument". Never null. */
FRAGMOTION_EXPORT const char* fragmotion_result_text(FragmotionResult result) FRAGMOTION_NOEXCEPT;

/* Whether each call looks whether its handles are alive, so that one that was released is an error rather than a crash.
 * On from the start in a library that was built for debugging; costs some 50 ns a call. */
FRAGMOTION_EXPORT void fragmotion_check_handles(int32_t on) FRAGMOTION_NOEXCEPT;

/* ---- the character ---------------------------------------------------------------------------------------------- */

typedef struct FragmotionLoadOptions {
  uint32_t size;
  FragmotionAxes axes;   /* FRAGMOTION_AXES_GLTF unless told */
  float units_per_metre; /* 1 unless told, 100 for centimetres: over 0 to 1e6 */
} FragmotionLoadOptions;

static inline FragmotionLoadOptions fragmotion_load_options(void) {
  FragmotionLoadOptions options;
  options.size = sizeof options;
  options.axes = FRAGMOTION_AXES_GLTF;
  options.units_per_metre = 1;
  return options;
}

/* Makes a character of a policy file's bytes, which are not needed afterwards. Nothing in them is trusted. It takes at
 * most 20 times as much memory as the file, beyond 50 MB. `options` may be null. `character` becomes null on failure.
 */
FRAGMOTION_EXPORT FragmotionResult fragmotion_character_load(const void* bytes, size_t size,
                                                             const FragmotionLoadOptions* options,
                                                             FragmotionCharacter** character) FRAGMOTION_NOEXCEPT;

/* Releases it; what plays it goes on. Null is fine. */
FRAGMOTION_EXPORT void fragmotion_character_release(FragmotionCharacter* character) FRAGMOTION_NOEXCEPT;

typedef struct FragmotionCharacterInfo {
  uint32_t size;
  int32_t bones;
  int32_t moves;
  int32_t styles;       /* 1 at least */
  int32_t hips;         /* the bone that moves; all others turn alone */
  int32_t jumps, turns; /* whether jumps and turns can be asked for: 0 or 1 */
  float height;         /* of the body, by its legs */
  float hips_height;    /* of the hips at rest */
  int32_t markers;      /* that animators set in its takes, each name once */
} FragmotionCharacterInfo;

typedef struct FragmotionBone {
  uint32_t size;
  int32_t parent;            /* -1: none; parents come before their children */
  const char* name;          /* UTF-8, the character's */
  FragmotionRole role;       /* */
  float length;              /* from head to tail */
  FragmotionTransform rest;  /* at rest, in its parent */
  FragmotionTransform model; /* at rest, as seen from where the character stands and faces */
} FragmotionBone;

typedef struct FragmotionMove {
  uint32_t size;
  int32_t upper_body; /* 1: only what is above the legs, which go on walking */
  int32_t loops;      /* 1: part of it is played again while it is held */
  const char* name;   /* UTF-8, the character's */
  float seconds;      /* that it lasts, without its loop played again */
  float wait;         /* s within which it begins, at the moment that joins best */
} FragmotionMove;

typedef struct FragmotionStyle {
  uint32_t size;
  int32_t classes;  /* of motion */
  int32_t speeds;   /* 1 .. 4 */
  const char* name; /* UTF-8, the character's; "" where there is but one style */
  float speed[4];   /* a second, the slowest first: what it was made to go at */
  float walk, run;  /* of these: the walk or what is nearest to it, and the fastest */
  float turn_rate;  /* rad/s at a turn of 1 */
} FragmotionStyle;

static inline FragmotionCharacterInfo fragmotion_info(void) {
  FragmotionCharacterInfo info = {sizeof info, 0, 0, 0, 0, 0, 0, 0, 0, 0};
  return info;
}
static inline FragmotionBone fragmotion_bone(void) {
  FragmotionBone bone = {
      sizeof bone, 0, NULL, FRAGMOTION_ROLE_NONE, 0, {{0, 0, 0}, {0, 0, 0, 1}}, {{0, 0, 0}, {0, 0, 0, 1}}};
  return bone;
}
static inline FragmotionMove fragmotion_move(void) {
  FragmotionMove move = {sizeof move, 0, 0, NULL, 0, 0};
  return move;
}
static inline FragmotionStyle fragmotion_style(void) {
  FragmotionStyle style = {sizeof style, 0, 0, NULL, {0, 0, 0, 0}, 0, 0, 0};
  return style;
}

/* What a character has. Names are valid as long as the character or one who plays it. */
FRAGMOTION_EXPORT FragmotionResult fragmotion_character_info(const FragmotionCharacter* character,
                                                             FragmotionCharacterInfo* info) FRAGMOTION_NOEXCEPT;
FRAGMOTION_EXPORT FragmotionResult fragmotion_character_bone(const FragmotionCharacter* character, int32_t index,
                                                             FragmotionBone* bone) FRAGMOTION_NOEXCEPT;
FRAGMOTION_EXPORT FragmotionResult fragmotion_character_move(const FragmotionCharacter* character, int32_t index,
                                                             FragmotionMove* move) FRAGMOTION_NOEXCEPT;
FRAGMOTION_EXPORT FragmotionResult fragmotion_character_style(const FragmotionCharacter* character, int32_t index,
                                                              FragmotionStyle* style) FRAGMOTION_NOEXCEPT;

/* What a class of a style's motion does, as "walk forward left"; null and an error where there is none. */
FRAGMOTION_EXPORT const char* fragmotion_character_class_name(const FragmotionCharacter* character, int32_t style,
                                                              int32_t index) FRAGMOTION_NOEXCEPT;

/* What an animator has named a marker of its takes, as "whoosh"; null and an error where there is none. */
FRAGMOTION_EXPORT const char* fragmotion_character_marker_name(const FragmotionCharacter* character,
                                                               int32_t index) FRAGMOTION_NOEXCEPT;

/* The number of a bone, a move, a style, a marker by its name; -1 where there is none, and on an error. A bone's name
 * is compared whole at first, and then without what importers change: what is before the last ':' or '|', "mixamorig",
 * signs, and the case of letters. */
FRAGMOTION_EXPORT int32_t fragmotion_character_find_bone(const FragmotionCharacter* character,
                                                         const char* name) FRAGMOTION_NOEXCEPT;
FRAGMOTION_EXPORT int32_t fragmotion_character_find_move(const FragmotionCharacter* character,
                                                         const char* name) FRAGMOTION_NOEXCEPT;
FRAGMOTION_EXPORT int32_t fragmotion_character_find_style(const FragmotionCharacter* character,
                                                          const char* name) FRAGMOTION_NOEXCEPT;
FRAGMOTION_EXPORT int32_t fragmotion_character_find_marker(const FragmotionCharacter* character,
                                                           const char* name) FRAGMOTION_NOEXCEPT;

/* ---- the rig: the game's own bones ------------------------------------------------------------------------------ */

typedef struct FragmotionRigOptions {
  uint32_t size;
  int32_t bones;                   /* how many the mesh has: 1 .. 65536 */
  const char* const* names;        /* of each; found in the character as by fragmotion_character_find_bone() */
  const int32_t* parents;          /* of each, -1: none, before their children; or null */
  const FragmotionTransform* rest; /* of each in its parent; or null */
  const float* inverse_binds;      /* 16 for each, in the engine's axes and unit; null: of the character's rest pose */
} FragmotionRigOptions;

static inline FragmotionRigOptions fragmotion_rig_options(void) {
  FragmotionRigOptions options = {sizeof options, 0, NULL, NULL, NULL, NULL};
  return options;
}

/* A rig writes poses in the game's order of bones. With `parents` and `rest`, bones that the character lacks rest on
 * their parents; without both, what is written for them stays as it was. Nothing of the options is needed afterwards.
 * `rig` becomes null on failure. */
FRAGMOTION_EXPORT FragmotionResult fragmotion_rig_create(const FragmotionCharacter* character,
                                                         const FragmotionRigOptions* options,
                                                         FragmotionRig** rig) FRAGMOTION_NOEXCEPT;
FRAGMOTION_EXPORT void fragmotion_rig_release(FragmotionRig* rig) FRAGMOTION_NOEXCEPT;

/* The character's bone that one of the rig's is, or -1: none, or an error. */
FRAGMOTION_EXPORT int32_t fragmotion_rig_bone(const FragmotionRig* rig, int32_t index) FRAGMOTION_NOEXCEPT;

/* ---- the player ------------------------------------------------------------------------------------------------- */

typedef struct FragmotionPlayerOptions {
  uint32_t size;
  uint32_t step_interval; /* level of detail: it plays on every n-th step, by their time in all; over 1, where feet are
                             not held, what it plays next is looked up, which takes a quarter of the time; 1 .. 64; 1 */
  uint64_t seed;          /* of what it chooses, from the next reset on; 1 */
  double responsiveness;  /* 0 .. 1: how soon what is asked for is done; 0.5 is what a body does */
  double root_adjustment; /* 0 .. 1: how much the body does of what is asked for beyond its motion; 1 */
  double stitch;          /* s in which one motion goes over into the next: 0, or 0.001 .. 1; 0.2 */
  double time_scale;      /* 0 .. 100; 0 pauses; 1 */
  double fixed_step;   /* s, 0.001 .. 1: it plays on by whole steps of this, and poses between two are interpolated, so
                          that the frame rate changes nothing; 0: by the very time of each step; 0 */
  int32_t hold_feet;   /* 1: feet that stand stay where they are; 1 */
  int32_t cross_fades; /* 1: both motions are mixed while one goes over into the next, for comparison; chosen as the
                          player is made; 0 */
} FragmotionPlayerOptions;

static inline FragmotionPlayerOptions fragmotion_player_options(void) {
  FragmotionPlayerOptions options = {sizeof options, 1, 1, 0.5, 1, 0.2, 1, 0, 1, 0};
  return options;
}

/* How FragmotionInput is meant. */
typedef int32_t FragmotionSteer;
enum {
  FRAGMOTION_STEER_CHARACTER = 0, /* move: velocity to the right and forward, as the character sees it */
  FRAGMOTION_STEER_WORLD = 1,     /* move: velocity in the world; facing: where to face in the world, or zeros */
  FRAGMOTION_STEER_CAMERA = 2, /* move: a stick to the right and up, within the unit circle, pushed half for a walk and
                                  fully for a run; facing: where the camera looks */
  FRAGMOTION_STEER_PATH = 3    /* along the path that is set; stands where there is none */
};

typedef struct FragmotionInput {
  uint32_t size;
  FragmotionSteer steer;
  float move[3];   /* as `steer` says; what of it is upward does not count. In each direction one goes at most as fast as
                      one walks, or 1.3 times as fast as the takes do within 30 degrees of it */
  float facing[3]; /* as `steer` says, of any length; likewise */
  float turn;   /* -1 right .. 1 left, times the turn rate, in all axes; with facing, and by the camera, 0 turns it by
                   itself */
  int32_t jump; /* 1 while it is pressed; one jump, however long */
} FragmotionInput;

static inline FragmotionInput fragmotion_input(void) {
  FragmotionInput input = {sizeof input, FRAGMOTION_STEER_CHARACTER, {0, 0, 0}, {0, 0, 0}, 0, 0};
  return input;
}

/* Makes a player, who stands at the origin. `options` may be null. `player` becomes null on failure. */
FRAGMOTION_EXPORT FragmotionResult fragmotion_player_create(const FragmotionCharacter* character,
                                                            const FragmotionPlayerOptions* options,
                                                            FragmotionPlayer** player) FRAGMOTION_NOEXCEPT;
/* Not of a player that a crowd has: those go with it. Null is fine. */
FRAGMOTION_EXPORT void fragmotion_player_release(FragmotionPlayer* player) FRAGMOTION_NOEXCEPT;

/* Changes options at any time, and tells them. */
FRAGMOTION_EXPORT FragmotionResult
fragmotion_player_set_options(FragmotionPlayer* player, const FragmotionPlayerOptions* options) FRAGMOTION_NOEXCEPT;
FRAGMOTION_EXPORT FragmotionResult fragmotion_player_options_of(const FragmotionPlayer* player,
                                                                FragmotionPlayerOptions* options) FRAGMOTION_NOEXCEPT;

/* Stands at a place, in a style, and draws again from the seed: after a reset the same steps show the same poses. Its
 * path is forgotten, its ground is kept. `place` may be null: the origin. */
FRAGMOTION_EXPORT FragmotionResult fragmotion_player_reset(FragmotionPlayer* player, const FragmotionPlace* place,
                                                           int32_t style) FRAGMOTION_NOEXCEPT;

/* Something else than its motion has put it there: a wall, a lift, a door, the ship it stands on. All goes along that
 * it does: feet that stand, stitches. Its path stays where it is. No event, and no motion of the step. */
FRAGMOTION_EXPORT FragmotionResult fragmotion_player_move_to(FragmotionPlayer* player,
                                                             const FragmotionPlace* place) FRAGMOTION_NOEXCEPT;

/* The ground below a place: its height along the up axis, and a normal of any length. */
typedef struct FragmotionGroundHit {
  float height;
  float normal[3];
} FragmotionGroundHit;

/* What of the ground is first below a place: not 0 where there is any. Called on the thread of the call that needs it:
 * at most 8 times in a step (with a fixed_step in each of these), 80 in a reset. It must not call the player that asks.
 * A foot in the air remembers what it asked, until move_to. */
typedef int32_t (*FragmotionGround)(void* user, const float from[3], FragmotionGroundHit* hit);

/* It stands and goes on this ground from now on; null: on level ground at the height of its place. */
FRAGMOTION_EXPORT FragmotionResult fragmotion_player_set_ground(FragmotionPlayer* player, FragmotionGround ground,
                                                                void* user) FRAGMOTION_NOEXCEPT;

/* Plays on for 0 to 3600 s. */
FRAGMOTION_EXPORT FragmotionResult fragmotion_player_step(FragmotionPlayer* player, const FragmotionInput* input,
                                                          double seconds) FRAGMOTION_NOEXCEPT;

/* A move, held from now on until it is released: it begins at the moment within its wait that joins best. */
FRAGMOTION_EXPORT FragmotionResult fragmotion_player_start_move(FragmotionPlayer* player,
                                                                int32_t move) FRAGMOTION_NOEXCEPT;
FRAGMOTION_EXPORT FragmotionResult fragmotion_player_release_move(FragmotionPlayer* player,
                                                                  int32_t move) FRAGMOTION_NOEXCEPT;

/* Goes on in another style, at the moment within 0.8 s that joins best. */
FRAGMOTION_EXPORT FragmotionResult fragmotion_player_change_style(FragmotionPlayer* player,
                                                                  int32_t style) FRAGMOTION_NOEXCEPT;

/* Where head and chest look, over whatever it plays: as far as they do in its takes, or do easily, and as fast. */
typedef int32_t FragmotionLook;
enum {
  FRAGMOTION_LOOK_AS_CAPTURED = 0, /* as its takes have it */
  FRAGMOTION_LOOK_AHEAD = 1,       /* where it goes */
  FRAGMOTION_LOOK_AT = 2           /* at a place; for what moves, told before each step */
};

/* Looks there from now on, until a reset. `place`: in the world; counts for FRAGMOTION_LOOK_AT, else it may be null. */
FRAGMOTION_EXPORT FragmotionResult fragmotion_player_look(FragmotionPlayer* player, FragmotionLook look,
                                                          const float place[3]) FRAGMOTION_NOEXCEPT;

/* What a hand holds or reaches for, over whatever it plays. */
typedef int32_t FragmotionHand;
enum { FRAGMOTION_LEFT_HAND = 0, FRAGMOTION_RIGHT_HAND = 1 };
typedef struct FragmotionReach {
  float place[3];  /* of the palm, */
  int32_t carried; /* 0: in the world; 1: along with the character: to its right, forward and over the ground */
  float weight;    /* 0: the hand is as captured .. 1: it is there */
} FragmotionReach;

/* Reaches for it from now on, until a reset; null: lets go. The hand goes there smoothly, also when it is told anew
 * before each step; it reaches for nothing that is far out of its reach, or behind it. */
FRAGMOTION_EXPORT FragmotionResult fragmotion_player_reach(FragmotionPlayer* player, FragmotionHand hand,
                                                           const FragmotionReach* reach) FRAGMOTION_NOEXCEPT;

/* Plays a class of its style's motion next, whatever is asked for. */
FRAGMOTION_EXPORT FragmotionResult fragmotion_player_force_class(FragmotionPlayer* player,
                                                                 int32_t index) FRAGMOTION_NOEXCEPT;

typedef struct FragmotionState {
  uint32_t size;
  int32_t style;           /* that it plays; */
  int32_t waiting_style;   /* that waits for its moment, -1: none */
  int32_t playing_class;   /* of the style */
  int32_t whole_body_move; /* that it plays, -1: none; likewise: */
  int32_t upper_body_move;
  int32_t waiting_whole_body_move, waiting_upper_body_move;
  int32_t foot_stands[2];  /* left, right: 0 or 1 */
  int32_t in_the_air;      /* of a jump: 0 or 1 */
  int32_t path_arrived;    /* 1: it stands at the end of its path */
  FragmotionPlace place;   /* as it is shown now */
  float rotation[4];       /* of place.heading: what an entity at place.position is turned by; x, y, z, w */
  float velocity[3];       /* of the last step, in the world; without moves of others */
  float motion[3];         /* root motion: how far the last step went, as seen from the place before it, */
  float motion_heading;    /* and by how much it turned */
  float ground_missed;     /* s without ground below it since it has one, or since its reset */
  float path_way;          /* how far along its path it has come */
  float path_seconds_left; /* until it is at the path's end */
} FragmotionState;

static inline FragmotionState fragmotion_state(void) {
  FragmotionState state = {sizeof state, 0,         0,         0, 0, 0, 0, 0, {0, 0}, 0, 0, {{0, 0, 0}, 0},
                           {0, 0, 0, 1}, {0, 0, 0}, {0, 0, 0}, 0, 0, 0, 0};
  return state;
}

/* Where it is and what it does. */
FRAGMOTION_EXPORT FragmotionResult fragmotion_player_state(const FragmotionPlayer* player,
                                                           FragmotionState* state) FRAGMOTION_NOEXCEPT;

typedef enum FragmotionEventType {
  FRAGMOTION_EVENT_FOOT_DOWN = 0,   /* index: 0 left, 1 right; position: the middle of its sole */
  FRAGMOTION_EVENT_FOOT_UP = 1,     /* likewise */
  FRAGMOTION_EVENT_TAKE_OFF = 2,    /* the last foot leaves the ground for a jump */
  FRAGMOTION_EVENT_LANDING = 3,     /* the first foot is back on it */
  FRAGMOTION_EVENT_MOVE_BEGINS = 4, /* index: the move; likewise: */
  FRAGMOTION_EVENT_MOVE_ENDS = 5,
  FRAGMOTION_EVENT_STYLE_CHANGES = 6, /* index: the style that plays from now on */
  FRAGMOTION_EVENT_PATH_ARRIVED = 7,
  FRAGMOTION_EVENT_MARKER = 8 /* index: the marker of the take or the move that plays */
} FragmotionEventType;

typedef struct FragmotionEvent {
  FragmotionEventType type;
  int32_t index;
  float position[3]; /* of the foot, else of the character's place */
  float seconds;     /* before the end of the step that it belongs to */
} FragmotionEvent;

/* The most events of a step; what comes in between in a long step is not told twice. */
#define FRAGMOTION_MOST_EVENTS 32

/* What happened in the last step: writes up to `capacity` events in their order, and how many to `count`. `events` may
 * be null where `capacity` is 0. */
FRAGMOTION_EXPORT FragmotionResult fragmotion_player_events(const FragmotionPlayer* player, FragmotionEvent* events,
                                                            int32_t capacity, int32_t* count) FRAGMOTION_NOEXCEPT;

/* The pose as it is shown: a transform for each bone of the rig, or of the character where `rig` is null. */
FRAGMOTION_EXPORT FragmotionResult fragmotion_player_pose(const FragmotionPlayer* player, const FragmotionRig* rig,
                                                          FragmotionSpace space, FragmotionTransform* bones,
                                                          int32_t count) FRAGMOTION_NOEXCEPT;

/* What a mesh is skinned with: for each bone its matrix in model or world space, times its inverse bind. 16 numbers a
 * bone, column by column. */
FRAGMOTION_EXPORT FragmotionResult fragmotion_player_skinning(const FragmotionPlayer* player, const FragmotionRig* rig,
                                                              FragmotionSpace space, float* matrices,
                                                              int32_t count) FRAGMOTION_NOEXCEPT;

/* Blends poses in local space, as of fragmotion_player_pose() and of other animation: `weight` 0 is `a`, 1 is `b`.
 * `mask`: times which the weight counts for each bone, 0 .. 1; may be null. `out` may be `a` or `b`. */
FRAGMOTION_EXPORT FragmotionResult fragmotion_blend(const FragmotionTransform* a, const FragmotionTransform* b,
                                                    float weight, const float* mask, int32_t count,
                                                    FragmotionTransform* out) FRAGMOTION_NOEXCEPT;

/* Where it would be, under an input that is held: `count` places, evenly over `seconds` to come (up to 60). It changes
 * nothing. Takes as long as the steps themselves, 60 a second. */
FRAGMOTION_EXPORT FragmotionResult fragmotion_player_foresee(FragmotionPlayer* player, const FragmotionInput* input,
                                                             double seconds, int32_t count,
                                                             FragmotionPlace* places) FRAGMOTION_NOEXCEPT;

/* ---- paths ------------------------------------------------------------------------------------------------------ */

typedef int32_t FragmotionPathEnd;
enum {
  FRAGMOTION_PATH_STAND = 0, /* it stops there; of a closed path, after one round */
  FRAGMOTION_PATH_LOOP = 1,  /* it goes round and round */
  FRAGMOTION_PATH_GO_ON = 2  /* it goes straight on */
};

typedef struct FragmotionPath {
  uint32_t size;
  int32_t points;         /* 2 .. a million */
  const float* positions; /* 3 for each, in the world */
  const float* speeds;    /* of each, a second, over 0; or null */
  int32_t closed;         /* 1: the last point leads back to the first */
  FragmotionPathEnd end;
  float speed;     /* a second where there are no speeds; 0: as fast as it walks */
  float arrive;    /* s after which it is to be at the end, whatever the speed; 0: any time */
  float facing[3]; /* where to face in the world; zeros: along the path */
} FragmotionPath;

static inline FragmotionPath fragmotion_path(void) {
  FragmotionPath path = {sizeof path, 0, NULL, NULL, 0, FRAGMOTION_PATH_STAND, 0, 0, {0, 0, 0}};
  return path;
}

/* What FRAGMOTION_STEER_PATH goes along from now on; from elsewhere it goes to the beginning first. Null: no path.
 * Nothing of it is needed afterwards. */
FRAGMOTION_EXPORT FragmotionResult fragmotion_player_set_path(FragmotionPlayer* player,
                                                              const FragmotionPath* path) FRAGMOTION_NOEXCEPT;

/* ---- state: rollback, replays, saved games ---------------------------------------------------------------------- */

/* How many bytes a player's state takes at most. 0 on an error. */
FRAGMOTION_EXPORT size_t fragmotion_player_save_size(const FragmotionPlayer* player) FRAGMOTION_NOEXCEPT;

/* Writes all that its next poses depend on, but for its character, its ground, and the points of its path. */
FRAGMOTION_EXPORT FragmotionResult fragmotion_player_save(const FragmotionPlayer* player, void* bytes, size_t capacity,
                                                          size_t* written) FRAGMOTION_NOEXCEPT;

/* Goes on from there, to the bit: this player, or another of the same character that has the same path. The bytes are
 * checked as a file is: bytes from a stranger do no harm, and a refused state changes nothing. */
FRAGMOTION_EXPORT FragmotionResult fragmotion_player_restore(FragmotionPlayer* player, const void* bytes,
                                                             size_t size) FRAGMOTION_NOEXCEPT;

/* A number that is the same where the states are the same. */
FRAGMOTION_EXPORT FragmotionResult fragmotion_player_checksum(const FragmotionPlayer* player,
                                                              uint64_t* checksum) FRAGMOTION_NOEXCEPT;

/* ---- crowds ----------------------------------------------------------------------------------------------------- */

/* `count` players, 0 to 100,000, in `parts` for as many jobs, 1 or more: player i has the seed options.seed + i, and
 * plays to the bit what it would play alone. Takes less memory than as many players. `options` may be null. `crowd`
 * becomes null on failure. */
FRAGMOTION_EXPORT FragmotionResult fragmotion_crowd_create(const FragmotionCharacter* character,
                                                           const FragmotionPlayerOptions* options, int32_t count,
                                                           int32_t parts, FragmotionCrowd** crowd) FRAGMOTION_NOEXCEPT;
FRAGMOTION_EXPORT void fragmotion_crowd_release(FragmotionCrowd* crowd) FRAGMOTION_NOEXCEPT;

/* Its players and parts: 0 on an error. */
FRAGMOTION_EXPORT int32_t fragmotion_crowd_count(const FragmotionCrowd* crowd) FRAGMOTION_NOEXCEPT;
FRAGMOTION_EXPORT int32_t fragmotion_crowd_parts(const FragmotionCrowd* crowd) FRAGMOTION_NOEXCEPT;

/* One of its players, for all functions above but fragmotion_player_release(); it is the crowd's. Null on an error. */
FRAGMOTION_EXPORT FragmotionPlayer* fragmotion_crowd_player(FragmotionCrowd* crowd, int32_t index) FRAGMOTION_NOEXCEPT;

/* Somebody or something else that a crowd makes way for, as if it were round. */
typedef struct FragmotionBody {
  float position[3], velocity[3]; /* in the world, a second */
  float radius;
} FragmotionBody;

/* In their next step, of so many seconds, its players keep clear of each other, with `radius` around each, and of
 * `count` others, who do not make way: each goes at the velocity next to what its input asks for by which none touches
 * another within 2 s, as long as all do so; who is held up goes round to the right, those whose input asks for nothing
 * step aside for him, and he waits where that does not help him for 10 s. To be called before each step, on one thread.
 * `others` may be null where `count` is 0. Allocates where they are more than ever before. */
FRAGMOTION_EXPORT FragmotionResult fragmotion_crowd_make_way(FragmotionCrowd* crowd, float radius, double seconds,
                                                             const FragmotionBody* others,
                                                             int32_t count) FRAGMOTION_NOEXCEPT;

/* Steps all under an input each, [count]; where one is wrong, nobody is stepped. */
FRAGMOTION_EXPORT FragmotionResult fragmotion_crowd_step(FragmotionCrowd* crowd, const FragmotionInput* inputs,
                                                         double seconds) FRAGMOTION_NOEXCEPT;
/* The same of one part's players; parts may be stepped at the same time. `inputs` are the whole crowd's. */
FRAGMOTION_EXPORT FragmotionResult fragmotion_crowd_step_part(FragmotionCrowd* crowd, int32_t part,
                                                              const FragmotionInput* inputs,
                                                              double seconds) FRAGMOTION_NOEXCEPT;

#ifdef __cplusplus
}
#endif
/* NOLINTEND(modernize-*) */

#endif
