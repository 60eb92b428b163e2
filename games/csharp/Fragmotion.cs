// SPDX-License-Identifier: MIT
//
// Fragmotion for C#, in one file on libfragmotion's C API: copy it into your project and put the library where your
// program finds its native ones. fragmotion.h says what each call does, its units and its ranges; README.md how to begin.
//
//     using (var hero = Character.Load(File.ReadAllBytes("hero.policy")))
//     using (var player = new Player(hero)) {
//       player.Step(Input.ByCamera(stick, cameraForward, jumps), seconds);
//       player.Pose(bones, Space.Local);
//     }
//
// What fails throws a FragmotionException, which says what was wrong and what to do. What you create you dispose, in any
// order; the garbage collector does it otherwise. Stepping, posing, saving into a buffer and restoring allocate nothing.
using System;
using System.Numerics;
using System.Runtime.ExceptionServices;
using System.Runtime.InteropServices;
using System.Text;
using Microsoft.Win32.SafeHandles;

namespace Fragmotion {

public enum Result {
  Ok, Argument, Size, Capacity, Handle, Refused, NewerVersion, OlderVersion, Memory, Internal
}

/// How an engine's axes lie; in Unity: Axes.Unity.
public enum Axes { Blender, Gltf, Unity, Unreal }

public enum Space { Local, Model, World }

public enum Role {
  None, Hips, Head, LeftHand, RightHand, LeftFoot, RightFoot, LeftToe, RightToe, LeftThigh, RightThigh
}

public enum Steer { Character, World, Camera, Path }

public enum Look { AsCaptured, Ahead, At }
public enum Hand { Left, Right }

public enum PathEnd { Stand, Loop, GoOn }

public enum EventType {
  FootDown, FootUp, TakeOff, Landing, MoveBegins, MoveEnds, StyleChanges, PathArrived, Marker
}

/// A bone's place and rotation.
[StructLayout(LayoutKind.Sequential)]
public struct Transform {
  public Vector3 Position;
  public Quaternion Rotation;
}

/// Where a character stands, and where it faces, rad.
[StructLayout(LayoutKind.Sequential)]
public struct Place {
  public Vector3 Position;
  public float Heading;
}

/// What a hand holds or reaches for: its palm's place, in the world or, Carried (1), to the character's right,
/// forward and over the ground under it, by a weight of 0 to 1. The default lets go.
[StructLayout(LayoutKind.Sequential)]
public struct Reach {
  public Vector3 Place;
  public int Carried;
  public float Weight;
}

/// What is asked of a player. The default asks it to stand.
[StructLayout(LayoutKind.Sequential)]
public struct Input {
  internal uint Size;
  public Steer Steer;
  public Vector3 Move;
  public Vector3 Facing;
  public float Turn;
  private int jump;

  public bool Jump {
    get { return jump != 0; }
    set { jump = value ? 1 : 0; }
  }

  /// Velocity to the right and forward as the character sees it, a second; turn -1 right .. 1 left.
  public static Input ByCharacter(float right, float forward, float turn = 0, bool jump = false) {
    return new Input { Move = new Vector3(right, forward, 0), Turn = turn, Jump = jump };
  }
  /// Velocity in the world, a second, and where to face; without facing it turns for nothing.
  public static Input ByWorld(Vector3 velocity, Vector3 facing = default(Vector3), bool jump = false) {
    return new Input { Steer = Steer.World, Move = velocity, Facing = facing, Jump = jump };
  }
  /// A stick to the right and up, within the unit circle: half for a walk, fully for a run.
  public static Input ByCamera(Vector2 stick, Vector3 cameraForward, bool jump = false) {
    return new Input { Steer = Steer.Camera, Move = new Vector3(stick, 0), Facing = cameraForward, Jump = jump };
  }
  /// Along the path that is set.
  public static Input ByPath() { return new Input { Steer = Steer.Path }; }
}

/// How a player plays; begin with PlayerOptions.Default.
[StructLayout(LayoutKind.Sequential)]
public struct PlayerOptions {
  internal uint Size;
  public uint StepInterval;
  public ulong Seed;
  public double Responsiveness;
  public double RootAdjustment;
  public double Stitch;
  public double TimeScale;
  public double FixedStep;
  private int holdFeet;
  private int crossFades;

  public bool HoldFeet {
    get { return holdFeet != 0; }
    set { holdFeet = value ? 1 : 0; }
  }
  /// Mixes both motions while one goes over into the next, for comparison; chosen as the player is made.
  public bool CrossFades {
    get { return crossFades != 0; }
    set { crossFades = value ? 1 : 0; }
  }
  public static PlayerOptions Default {
    get {
      return new PlayerOptions { StepInterval = 1, Seed = 1, Responsiveness = 0.5, RootAdjustment = 1, Stitch = 0.2,
                                 TimeScale = 1, HoldFeet = true };
    }
  }
}

/// Where a player is and what it does.
[StructLayout(LayoutKind.Sequential)]
public struct State {
  internal uint Size;
  public int Style, WaitingStyle, PlayingClass;
  public int WholeBodyMove, UpperBodyMove, WaitingWholeBodyMove, WaitingUpperBodyMove;
  private int leftFootStands, rightFootStands, inTheAir, pathArrived;
  public Place Place;
  public Quaternion Rotation;
  public Vector3 Velocity;
  public Vector3 Motion;
  public float MotionHeading;
  public float GroundMissed;
  public float PathWay;
  public float PathSecondsLeft;

  public bool LeftFootStands { get { return leftFootStands != 0; } }
  public bool RightFootStands { get { return rightFootStands != 0; } }
  public bool InTheAir { get { return inTheAir != 0; } }
  public bool PathArrived { get { return pathArrived != 0; } }
}

/// What happened in a step; Index is the foot (0 left, 1 right), the move or the style.
[StructLayout(LayoutKind.Sequential)]
public struct Event {
  public EventType Type;
  public int Index;
  public Vector3 Position;
  public float Seconds;
}

/// Somebody or something else that a crowd makes way for, as if it were round; its velocity a second.
[StructLayout(LayoutKind.Sequential)]
public struct Body {
  public Vector3 Position;
  public Vector3 Velocity;
  public float Radius;
}

/// The ground below a place: its height along the up axis, and a normal of any length.
[StructLayout(LayoutKind.Sequential)]
public struct GroundHit {
  public float Height;
  public Vector3 Normal;
}

/// What of the ground is first below a place; false where there is none. It must not call the player that asks.
public delegate bool Ground(Vector3 from, out GroundHit hit);

[StructLayout(LayoutKind.Sequential)]
public struct CharacterInfo {
  internal uint Size;
  public int Bones, Moves, Styles, Hips;
  private int jumps, turns;
  public float Height, HipsHeight;
  public int Markers;

  public bool Jumps { get { return jumps != 0; } }
  public bool Turns { get { return turns != 0; } }
}

public struct Bone {
  public string Name;
  public int Parent;
  public Role Role;
  public float Length;
  /// At rest, in its parent; and as seen from where the character stands and faces.
  public Transform Rest, Model;
}

public struct Move {
  public string Name;
  public bool UpperBody, Loops;
  public float Seconds, Wait;
}

public struct Style {
  public string Name;
  public int Classes;
  public float[] Speeds;
  public float Walk, Run, TurnRate;
}

/// What to walk along: see Player.SetPath.
public sealed class WalkPath {
  public Vector3[] Points;
  public float[] Speeds;
  public bool Closed;
  public PathEnd End;
  public float Speed, Arrive;
  public Vector3 Facing;
}

/// A call that failed: what was wrong, where, and what to do.
public sealed class FragmotionException : Exception {
  public readonly Result Result;
  internal FragmotionException(Result result, string words) : base(words) { Result = result; }
}

public static class Library {
  /// "0.1.0".
  public static string Version { get { return Utf8.Read(Native.fragmotion_version()); } }

  /// Blends poses in local space; weight 0 is a, 1 is b, times the mask's for each bone. `result` may be a or b.
  public static void Blend(Transform[] a, Transform[] b, float weight, float[] mask, Transform[] result) {
    if (a.Length != b.Length || a.Length != result.Length || (mask != null && mask.Length != a.Length)) {
      throw new ArgumentException("the poses, the mask and the result must have as many bones each");
    }
    Native.Check(Native.fragmotion_blend(a, b, weight, mask, a.Length, result));
  }
}

/// What a policy file holds: shared by all who play it, by any number of threads.
public sealed class Character : IDisposable {
  internal readonly CharacterHandle Handle;
  public readonly CharacterInfo Info;

  private Character(CharacterHandle handle) {
    Handle = handle;
    var info = new CharacterInfo { Size = Native.SizeOf<CharacterInfo>() };
    Native.Check(Native.fragmotion_character_info(handle, ref info));
    Info = info;
  }

  public static Character Load(byte[] policy, Axes axes = Axes.Gltf, float unitsPerMetre = 1) {
    var options = new NativeLoadOptions { Axes = axes, UnitsPerMetre = unitsPerMetre };
    options.Size = Native.SizeOf<NativeLoadOptions>();
    CharacterHandle handle;
    Native.Check(Native.fragmotion_character_load(policy, (UIntPtr)policy.Length, ref options, out handle));
    return new Character(handle);
  }

  public void Dispose() { Handle.Dispose(); }

  public Bone Bone(int index) {
    var bone = new NativeBone { Size = Native.SizeOf<NativeBone>() };
    Native.Check(Native.fragmotion_character_bone(Handle, index, ref bone));
    return new Bone { Name = Utf8.Read(bone.Name), Parent = bone.Parent, Role = bone.Role, Length = bone.Length,
                      Rest = bone.Rest, Model = bone.Model };
  }
  public Move Move(int index) {
    var move = new NativeMove { Size = Native.SizeOf<NativeMove>() };
    Native.Check(Native.fragmotion_character_move(Handle, index, ref move));
    return new Move { Name = Utf8.Read(move.Name), UpperBody = move.UpperBody != 0, Loops = move.Loops != 0,
                      Seconds = move.Seconds, Wait = move.Wait };
  }
  public Style Style(int index) {
    var style = new NativeStyle { Size = Native.SizeOf<NativeStyle>() };
    Native.Check(Native.fragmotion_character_style(Handle, index, ref style));
    var speeds = new[] { style.Speeds.X, style.Speeds.Y, style.Speeds.Z, style.Speeds.W };
    Array.Resize(ref speeds, style.SpeedCount);
    return new Style { Name = Utf8.Read(style.Name), Classes = style.Classes, Speeds = speeds, Walk = style.Walk,
                       Run = style.Run, TurnRate = style.TurnRate };
  }
  /// What a class of a style's motion does: "walk forward left".
  public string ClassName(int style, int index) {
    var name = Native.fragmotion_character_class_name(Handle, style, index);
    if (name == IntPtr.Zero) throw new FragmotionException(Result.Argument, Native.LastError());
    return Utf8.Read(name);
  }

  /// What an animator has named a marker of its takes: "whoosh".
  public string MarkerName(int index) {
    var name = Native.fragmotion_character_marker_name(Handle, index);
    if (name == IntPtr.Zero) throw new FragmotionException(Result.Argument, Native.LastError());
    return Utf8.Read(name);
  }

  /// The number of a bone, a move, a style, a marker by its name; -1 where there is none.
  public int FindBone(string name) { return Native.fragmotion_character_find_bone(Handle, Utf8.Bytes(name)); }
  public int FindMove(string name) { return Native.fragmotion_character_find_move(Handle, Utf8.Bytes(name)); }
  public int FindStyle(string name) { return Native.fragmotion_character_find_style(Handle, Utf8.Bytes(name)); }
  public int FindMarker(string name) { return Native.fragmotion_character_find_marker(Handle, Utf8.Bytes(name)); }
}

/// The bones of a mesh as the game has them: poses come in their order.
public sealed class Rig : IDisposable {
  internal readonly RigHandle Handle;
  public readonly int Bones;

  /// The names of the bones; and, or null: their parents (-1: none) and how they rest in them, and 16 numbers of an
  /// inverse bind matrix for each, column by column.
  public Rig(Character character, string[] names, int[] parents = null, Transform[] rest = null,
             float[] inverseBinds = null) {
    Bones = names.Length;
    if ((parents != null && parents.Length != Bones) || (rest != null && rest.Length != Bones) ||
        (inverseBinds != null && inverseBinds.Length != 16 * Bones)) {
      throw new ArgumentException("parents, rest and inverseBinds must be for as many bones as there are names");
    }
    using (var pins = new Pins()) {
      var pointers = new IntPtr[Bones];
      for (int i = 0; i < Bones; ++i) pointers[i] = pins.Of(Utf8.Bytes(names[i]));
      var options = new NativeRigOptions { Size = Native.SizeOf<NativeRigOptions>(), Bones = Bones,
                                           Names = pins.Of(pointers), Parents = pins.Of(parents), Rest = pins.Of(rest),
                                           InverseBinds = pins.Of(inverseBinds) };
      Native.Check(Native.fragmotion_rig_create(character.Handle, ref options, out Handle));
    }
  }

  public void Dispose() { Handle.Dispose(); }

  /// The character's bone that one of the rig's is, or -1.
  public int Bone(int index) { return Native.fragmotion_rig_bone(Handle, index); }
}

/// One that plays a character; used by one thread at a time.
public sealed class Player : IDisposable {
  internal readonly PlayerHandle Handle;
  private Ground ground;

  public Player(Character character) : this(character, PlayerOptions.Default) {}

  public Player(Character character, PlayerOptions options) {
    options.Size = Native.SizeOf<PlayerOptions>();
    Native.Check(Native.fragmotion_player_create(character.Handle, ref options, out Handle));
  }

  internal Player(PlayerHandle handle) { Handle = handle; }

  /// Not of a player that a crowd has: it goes with the crowd.
  public void Dispose() { Handle.Dispose(); }

  public PlayerOptions Options {
    get {
      var options = new PlayerOptions { Size = Native.SizeOf<PlayerOptions>() };
      Native.Check(Native.fragmotion_player_options_of(Handle, ref options));
      return options;
    }
    set {
      value.Size = Native.SizeOf<PlayerOptions>();
      Native.Check(Native.fragmotion_player_set_options(Handle, ref value));
    }
  }

  public State State {
    get {
      var state = new State { Size = Native.SizeOf<State>() };
      Native.Check(Native.fragmotion_player_state(Handle, ref state));
      return state;
    }
  }

  /// Stands at a place in a style, and draws again from the seed; its path is forgotten.
  public void Reset(Place place = default(Place), int style = 0) {
    Native.Check(Native.fragmotion_player_reset(Handle, ref place, style));
  }
  /// Something else than its motion has put it there: a wall, a lift, a door.
  public void MoveTo(Place place) { Native.Check(Native.fragmotion_player_move_to(Handle, ref place)); }

  /// It stands and goes on this ground from now on; null: on level ground. What it throws comes out of the step.
  public void SetGround(Ground newGround) {
    ground = newGround;
    var callback = newGround == null ? null : Native.GroundCallback;
    Native.Check(Native.fragmotion_player_set_ground(Handle, callback, Handle.Reference(this)));
  }
  internal bool AskGround(Vector3 from, out GroundHit hit) { return ground(from, out hit); }

  /// Plays on for 0 to 3600 s.
  public void Step(Input input, double seconds) {
    input.Size = Native.SizeOf<Input>();
    Native.Check(Native.fragmotion_player_step(Handle, ref input, seconds));
    GC.KeepAlive(this);
  }

  public void StartMove(int move) { Native.Check(Native.fragmotion_player_start_move(Handle, move)); }
  public void ReleaseMove(int move) { Native.Check(Native.fragmotion_player_release_move(Handle, move)); }
  public void ChangeStyle(int style) { Native.Check(Native.fragmotion_player_change_style(Handle, style)); }
  /// Head and chest look there from now on, until a reset: `place` counts where it looks at one.
  public void LookTo(Look look, Vector3 place = default(Vector3)) {
    Native.Check(Native.fragmotion_player_look(Handle, look, ref place));
  }
  /// The palm of a hand is there from now on, until a reset: it goes there smoothly.
  public void ReachFor(Hand hand, Reach reach) { Native.Check(Native.fragmotion_player_reach(Handle, hand, ref reach)); }
  public void LetGo(Hand hand) { ReachFor(hand, default(Reach)); }
  public void ForceClass(int index) { Native.Check(Native.fragmotion_player_force_class(Handle, index)); }

  /// The most events of a step.
  public const int MostEvents = 32;

  /// Writes what happened in the last step, in its order, and returns how many events it was.
  public int Events(Event[] events) {
    int count;
    Native.Check(Native.fragmotion_player_events(Handle, events, events.Length, out count));
    return count;
  }

  /// A transform for each bone of the rig, or of the character where there is no rig.
  public void Pose(Transform[] bones, Space space, Rig rig = null) {
    var handle = rig == null ? RigHandle.None : rig.Handle;
    Native.Check(Native.fragmotion_player_pose(Handle, handle, space, bones, bones.Length));
  }
  /// What a mesh is skinned with: 16 numbers for each bone of the rig, column by column.
  public void Skinning(float[] matrices, Space space, Rig rig) {
    Native.Check(Native.fragmotion_player_skinning(Handle, rig.Handle, space, matrices, matrices.Length / 16));
  }

  /// Where it would be under an input that is held: places evenly over the seconds to come, up to 60.
  public void Foresee(Input input, double seconds, Place[] places) {
    input.Size = Native.SizeOf<Input>();
    Native.Check(Native.fragmotion_player_foresee(Handle, ref input, seconds, places.Length, places));
    GC.KeepAlive(this);
  }

  /// What Input.ByPath goes along from now on; null: no path.
  public void SetPath(WalkPath path) {
    using (var pins = new Pins()) {
      var options = path == null ? IntPtr.Zero : pins.Of(new[] { NativePath.Of(path, pins) });
      Native.Check(Native.fragmotion_player_set_path(Handle, options));
    }
  }

  /// How many bytes its state takes at most.
  public int SaveSize { get { return (int)Native.fragmotion_player_save_size(Handle); } }

  /// Writes all that its next poses depend on, but for its character, ground and path; returns how many bytes it was.
  public int Save(byte[] bytes) {
    UIntPtr written;
    Native.Check(Native.fragmotion_player_save(Handle, bytes, (UIntPtr)bytes.Length, out written));
    return (int)written;
  }
  /// Goes on from there, to the bit. The bytes are checked: those of a stranger do no harm.
  public void Restore(byte[] bytes, int size) {
    if (size < 0 || size > bytes.Length) throw new ArgumentOutOfRangeException("size", "beyond the bytes");
    Native.Check(Native.fragmotion_player_restore(Handle, bytes, (UIntPtr)size));
  }
  /// The same where the states are the same.
  public ulong Checksum {
    get {
      ulong checksum;
      Native.Check(Native.fragmotion_player_checksum(Handle, out checksum));
      return checksum;
    }
  }
}

/// Many that play a character, in parts for the game's jobs.
public sealed class Crowd : IDisposable {
  private readonly CrowdHandle handle;
  private readonly Player[] players;
  public readonly int Parts;

  public Crowd(Character character, int count, int parts = 1) : this(character, count, parts, PlayerOptions.Default) {}

  public Crowd(Character character, int count, int parts, PlayerOptions options) {
    options.Size = Native.SizeOf<PlayerOptions>();
    Native.Check(Native.fragmotion_crowd_create(character.Handle, ref options, count, parts, out handle));
    players = new Player[count];
    Parts = parts;
    for (int i = 0; i < count; ++i) {
      players[i] = new Player(new PlayerHandle(handle, Native.fragmotion_crowd_player(handle, i)));
    }
  }

  public void Dispose() {
    foreach (var player in players) player.Dispose();
    handle.Dispose();
  }

  public int Count { get { return players.Length; } }
  public Player this[int index] { get { return players[index]; } }

  /// In their next step, of so many seconds, its players keep clear of each other, with a radius around each, and of
  /// others, who do not make way. To be called before each step.
  public void MakeWay(float radius, double seconds, params Body[] others) {
    Native.Check(Native.fragmotion_crowd_make_way(handle, radius, seconds, others, others.Length));
    GC.KeepAlive(this);
  }
  /// Steps all under an input each.
  public void Step(Input[] inputs, double seconds) {
    Native.Check(Native.fragmotion_crowd_step(handle, Sized(inputs), seconds));
    GC.KeepAlive(this);
  }
  /// The same of one part's players, also while others step other parts. The inputs are the whole crowd's.
  public void StepPart(int part, Input[] inputs, double seconds) {
    Native.Check(Native.fragmotion_crowd_step_part(handle, part, Sized(inputs), seconds));
    GC.KeepAlive(this);
  }

  private Input[] Sized(Input[] inputs) {
    if (inputs.Length != Count) throw new ArgumentException("there must be an input for each of the crowd");
    for (int i = 0; i < inputs.Length; ++i) inputs[i].Size = Native.SizeOf<Input>();
    return inputs;
  }
}

// ---- handles --------------------------------------------------------------------------------------------------------

internal sealed class CharacterHandle : SafeHandleZeroOrMinusOneIsInvalid {
  public CharacterHandle() : base(true) {}
  protected override bool ReleaseHandle() {
    Native.fragmotion_character_release(handle);
    return true;
  }
}

internal sealed class RigHandle : SafeHandleZeroOrMinusOneIsInvalid {
  public static readonly RigHandle None = new RigHandle();
  public RigHandle() : base(true) {}
  protected override bool ReleaseHandle() {
    Native.fragmotion_rig_release(handle);
    return true;
  }
}

internal sealed class CrowdHandle : SafeHandleZeroOrMinusOneIsInvalid {
  public CrowdHandle() : base(true) {}
  protected override bool ReleaseHandle() {
    Native.fragmotion_crowd_release(handle);
    return true;
  }
}

/// A player's handle: its own, or one that keeps its crowd alive; and the weak reference by which its ground is asked.
internal sealed class PlayerHandle : SafeHandleZeroOrMinusOneIsInvalid {
  private readonly CrowdHandle crowd;
  private GCHandle reference;

  public PlayerHandle() : base(true) {}
  public PlayerHandle(CrowdHandle crowd, IntPtr player) : base(true) {
    bool added = false;
    crowd.DangerousAddRef(ref added);
    this.crowd = crowd;
    SetHandle(player);
  }

  public IntPtr Reference(Player player) {
    if (!reference.IsAllocated) reference = GCHandle.Alloc(player, GCHandleType.Weak);
    return GCHandle.ToIntPtr(reference);
  }

  protected override bool ReleaseHandle() {
    if (crowd != null) crowd.DangerousRelease();
    else Native.fragmotion_player_release(handle);
    if (reference.IsAllocated) reference.Free();
    return true;
  }
}

/// Arrays that stay where they are until this is disposed.
internal sealed class Pins : IDisposable {
  private readonly System.Collections.Generic.List<GCHandle> pins = new System.Collections.Generic.List<GCHandle>();

  public IntPtr Of(Array array) {
    if (array == null) return IntPtr.Zero;
    var pin = GCHandle.Alloc(array, GCHandleType.Pinned);
    pins.Add(pin);
    return pin.AddrOfPinnedObject();
  }
  public void Dispose() {
    foreach (var pin in pins) pin.Free();
  }
}

internal static class Utf8 {
  public static byte[] Bytes(string text) { return Encoding.UTF8.GetBytes(text + '\0'); }

  public static string Read(IntPtr text) {
    int length = 0;
    while (Marshal.ReadByte(text, length) != 0) ++length;
    var bytes = new byte[length];
    Marshal.Copy(text, bytes, 0, length);
    return Encoding.UTF8.GetString(bytes);
  }
}

// ---- the C API ------------------------------------------------------------------------------------------------------

[StructLayout(LayoutKind.Sequential)]
internal struct NativeLoadOptions {
  public uint Size;
  public Axes Axes;
  public float UnitsPerMetre;
}

[StructLayout(LayoutKind.Sequential)]
internal struct NativeBone {
  public uint Size;
  public int Parent;
  public IntPtr Name;
  public Role Role;
  public float Length;
  public Transform Rest, Model;
}

[StructLayout(LayoutKind.Sequential)]
internal struct NativeMove {
  public uint Size;
  public int UpperBody, Loops;
  public IntPtr Name;
  public float Seconds, Wait;
}

[StructLayout(LayoutKind.Sequential)]
internal struct NativeStyle {
  public uint Size;
  public int Classes, SpeedCount;
  public IntPtr Name;
  public Vector4 Speeds;
  public float Walk, Run, TurnRate;
}

[StructLayout(LayoutKind.Sequential)]
internal struct NativeRigOptions {
  public uint Size;
  public int Bones;
  public IntPtr Names, Parents, Rest, InverseBinds;
}

[StructLayout(LayoutKind.Sequential)]
internal struct NativePath {
  public uint Size;
  public int Points;
  public IntPtr Positions, Speeds;
  public int Closed;
  public PathEnd End;
  public float Speed, Arrive;
  public Vector3 Facing;

  public static NativePath Of(WalkPath path, Pins pins) {
    if (path.Speeds != null && path.Speeds.Length != path.Points.Length) {
      throw new ArgumentException("a path's speeds must be as many as its points");
    }
    return new NativePath { Size = Native.SizeOf<NativePath>(), Points = path.Points.Length,
                            Positions = pins.Of(path.Points), Speeds = pins.Of(path.Speeds),
                            Closed = path.Closed ? 1 : 0, End = path.End, Speed = path.Speed, Arrive = path.Arrive,
                            Facing = path.Facing };
  }
}

[UnmanagedFunctionPointer(CallingConvention.Cdecl)]
internal delegate int NativeGround(IntPtr user, ref Vector3 from, out GroundHit hit);

/// Unity's IL2CPP finds by this name what is called from native code.
[AttributeUsage(AttributeTargets.Method)]
internal sealed class MonoPInvokeCallbackAttribute : Attribute {
  public MonoPInvokeCallbackAttribute(Type type) {}
}

internal static class Native {
#if (UNITY_IOS || UNITY_WEBGL) && !UNITY_EDITOR
  private const string Name = "__Internal";
#else
  private const string Name = "fragmotion";
#endif
  private const CallingConvention C = CallingConvention.Cdecl;

  public static readonly NativeGround GroundCallback = AskGround;
  [ThreadStatic]
  private static Exception groundFailure;

  [MonoPInvokeCallback(typeof(NativeGround))]
  private static int AskGround(IntPtr user, ref Vector3 from, out GroundHit hit) {
    hit = default(GroundHit);
    try {
      var player = (Player)GCHandle.FromIntPtr(user).Target;
      return player.AskGround(from, out hit) ? 1 : 0;
    } catch (Exception failure) {  // which must not go through native code
      groundFailure = groundFailure ?? failure;
      return 0;
    }
  }

  /// Throws what a call failed with, or what a ground threw while it went on.
  public static void Check(Result result) {
    if (groundFailure != null) {
      var failure = groundFailure;
      groundFailure = null;
      ExceptionDispatchInfo.Capture(failure).Throw();
    }
    if (result != Result.Ok) throw new FragmotionException(result, LastError());
  }
  public static string LastError() { return Utf8.Read(fragmotion_last_error()); }

  public static uint SizeOf<T>() where T : struct { return Sizes<T>.Size; }
  private static class Sizes<T> {
    public static readonly uint Size = (uint)Marshal.SizeOf(typeof(T));
  }

  [DllImport(Name, CallingConvention = C)] public static extern IntPtr fragmotion_version();
  [DllImport(Name, CallingConvention = C)] public static extern IntPtr fragmotion_last_error();

  [DllImport(Name, CallingConvention = C)]
  public static extern Result fragmotion_character_load(byte[] bytes, UIntPtr size, ref NativeLoadOptions options,
                                                        out CharacterHandle character);
  [DllImport(Name, CallingConvention = C)] public static extern void fragmotion_character_release(IntPtr character);
  [DllImport(Name, CallingConvention = C)]
  public static extern Result fragmotion_character_info(CharacterHandle character, ref CharacterInfo info);
  [DllImport(Name, CallingConvention = C)]
  public static extern Result fragmotion_character_bone(CharacterHandle character, int index, ref NativeBone bone);
  [DllImport(Name, CallingConvention = C)]
  public static extern Result fragmotion_character_move(CharacterHandle character, int index, ref NativeMove move);
  [DllImport(Name, CallingConvention = C)]
  public static extern Result fragmotion_character_style(CharacterHandle character, int index, ref NativeStyle style);
  [DllImport(Name, CallingConvention = C)]
  public static extern IntPtr fragmotion_character_class_name(CharacterHandle character, int style, int index);
  [DllImport(Name, CallingConvention = C)]
  public static extern int fragmotion_character_find_bone(CharacterHandle character, byte[] name);
  [DllImport(Name, CallingConvention = C)]
  public static extern int fragmotion_character_find_move(CharacterHandle character, byte[] name);
  [DllImport(Name, CallingConvention = C)]
  public static extern int fragmotion_character_find_style(CharacterHandle character, byte[] name);
  [DllImport(Name, CallingConvention = C)]
  public static extern IntPtr fragmotion_character_marker_name(CharacterHandle character, int index);
  [DllImport(Name, CallingConvention = C)]
  public static extern int fragmotion_character_find_marker(CharacterHandle character, byte[] name);

  [DllImport(Name, CallingConvention = C)]
  public static extern Result fragmotion_rig_create(CharacterHandle character, ref NativeRigOptions options,
                                                    out RigHandle rig);
  [DllImport(Name, CallingConvention = C)] public static extern void fragmotion_rig_release(IntPtr rig);
  [DllImport(Name, CallingConvention = C)] public static extern int fragmotion_rig_bone(RigHandle rig, int index);

  [DllImport(Name, CallingConvention = C)]
  public static extern Result fragmotion_player_create(CharacterHandle character, ref PlayerOptions options,
                                                       out PlayerHandle player);
  [DllImport(Name, CallingConvention = C)] public static extern void fragmotion_player_release(IntPtr player);
  [DllImport(Name, CallingConvention = C)]
  public static extern Result fragmotion_player_set_options(PlayerHandle player, ref PlayerOptions options);
  [DllImport(Name, CallingConvention = C)]
  public static extern Result fragmotion_player_options_of(PlayerHandle player, ref PlayerOptions options);
  [DllImport(Name, CallingConvention = C)]
  public static extern Result fragmotion_player_reset(PlayerHandle player, ref Place place, int style);
  [DllImport(Name, CallingConvention = C)]
  public static extern Result fragmotion_player_move_to(PlayerHandle player, ref Place place);
  [DllImport(Name, CallingConvention = C)]
  public static extern Result fragmotion_player_set_ground(PlayerHandle player, NativeGround ground, IntPtr user);
  [DllImport(Name, CallingConvention = C)]
  public static extern Result fragmotion_player_step(PlayerHandle player, ref Input input, double seconds);
  [DllImport(Name, CallingConvention = C)]
  public static extern Result fragmotion_player_start_move(PlayerHandle player, int move);
  [DllImport(Name, CallingConvention = C)]
  public static extern Result fragmotion_player_release_move(PlayerHandle player, int move);
  [DllImport(Name, CallingConvention = C)]
  public static extern Result fragmotion_player_change_style(PlayerHandle player, int style);
  [DllImport(Name, CallingConvention = C)]
  public static extern Result fragmotion_player_reach(PlayerHandle player, Hand hand, ref Reach reach);
  [DllImport(Name, CallingConvention = C)]
  public static extern Result fragmotion_player_look(PlayerHandle player, Look look, ref Vector3 place);
  [DllImport(Name, CallingConvention = C)]
  public static extern Result fragmotion_player_force_class(PlayerHandle player, int index);
  [DllImport(Name, CallingConvention = C)]
  public static extern Result fragmotion_player_state(PlayerHandle player, ref State state);
  [DllImport(Name, CallingConvention = C)]
  public static extern Result fragmotion_player_events(PlayerHandle player, [Out] Event[] events, int capacity,
                                                       out int count);
  [DllImport(Name, CallingConvention = C)]
  public static extern Result fragmotion_player_pose(PlayerHandle player, RigHandle rig, Space space,
                                                     [In, Out] Transform[] bones, int count);
  [DllImport(Name, CallingConvention = C)]
  public static extern Result fragmotion_player_skinning(PlayerHandle player, RigHandle rig, Space space,
                                                         [In, Out] float[] matrices, int count);
  [DllImport(Name, CallingConvention = C)]
  public static extern Result fragmotion_player_foresee(PlayerHandle player, ref Input input, double seconds, int count,
                                                        [Out] Place[] places);
  [DllImport(Name, CallingConvention = C)]
  public static extern Result fragmotion_player_set_path(PlayerHandle player, IntPtr path);
  [DllImport(Name, CallingConvention = C)] public static extern UIntPtr fragmotion_player_save_size(PlayerHandle player);
  [DllImport(Name, CallingConvention = C)]
  public static extern Result fragmotion_player_save(PlayerHandle player, [Out] byte[] bytes, UIntPtr capacity,
                                                     out UIntPtr written);
  [DllImport(Name, CallingConvention = C)]
  public static extern Result fragmotion_player_restore(PlayerHandle player, byte[] bytes, UIntPtr size);
  [DllImport(Name, CallingConvention = C)]
  public static extern Result fragmotion_player_checksum(PlayerHandle player, out ulong checksum);
  [DllImport(Name, CallingConvention = C)]
  public static extern Result fragmotion_blend(Transform[] a, Transform[] b, float weight, float[] mask, int count,
                                               [In, Out] Transform[] result);

  [DllImport(Name, CallingConvention = C)]
  public static extern Result fragmotion_crowd_create(CharacterHandle character, ref PlayerOptions options, int count,
                                                      int parts, out CrowdHandle crowd);
  [DllImport(Name, CallingConvention = C)] public static extern void fragmotion_crowd_release(IntPtr crowd);
  [DllImport(Name, CallingConvention = C)]
  public static extern IntPtr fragmotion_crowd_player(CrowdHandle crowd, int index);
  [DllImport(Name, CallingConvention = C)]
  public static extern Result fragmotion_crowd_make_way(CrowdHandle crowd, float radius, double seconds, Body[] others,
                                                        int count);
  [DllImport(Name, CallingConvention = C)]
  public static extern Result fragmotion_crowd_step(CrowdHandle crowd, Input[] inputs, double seconds);
  [DllImport(Name, CallingConvention = C)]
  public static extern Result fragmotion_crowd_step_part(CrowdHandle crowd, int part, Input[] inputs, double seconds);
}

}  // namespace Fragmotion
