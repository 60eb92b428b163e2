// SPDX-License-Identifier: MIT
// For Unity, and untried inside it: put this on the object above the imported mesh, and Fragmotion.cs beside it.
using System.Collections.Generic;
using UnityEngine;
using Fm = Fragmotion;
using Numerics = System.Numerics;

/// Plays a policy on the bones below it, which it finds by their names, and carries this object along.
public sealed class FragmotionCharacter : MonoBehaviour {
  [Tooltip("The policy file, renamed to .bytes")]
  public TextAsset policy;
  [Tooltip("The stick points where this looks; none: it is steered by the world's axes")]
  public Transform view;
  [Tooltip("It stands and walks on the colliders of these layers; nothing: on level ground")]
  public LayerMask ground;
  [Tooltip("If there is one, the motion goes through it, so that walls stop the character")]
  public CharacterController controller;

  /// What is asked of it from now on: a stick within the unit circle, and a button.
  [System.NonSerialized] public Vector2 stick;
  [System.NonSerialized] public bool jump;

  /// What happens in its motion: Index is the foot, 0 left, 1 right, or the move or the style.
  public event System.Action<Fm.Event> Happened;

  /// Moves, styles, paths, saved states: all else that a player can do. It is there from Awake on.
  public Fm.Player Player { get; private set; }
  public Fm.Character Character { get; private set; }

  private readonly Fm.Event[] events = new Fm.Event[Fm.Player.MostEvents];
  private Transform[] bones;
  private bool[] isHips, isTop;
  private Fm.Transform[] pose;
  private Fm.Rig rig;

  private void Awake() {
    Character = Fm.Character.Load(policy.bytes, Fm.Axes.Unity);
    Player = new Fm.Player(Character);
    FindBones();
    if (ground.value != 0) Player.SetGround(Below);
    Player.Reset(new Fm.Place { Position = From(transform.position),
                                Heading = transform.eulerAngles.y * Mathf.Deg2Rad });
  }

  private void OnDestroy() {
    if (rig != null) rig.Dispose();
    if (Player != null) Player.Dispose();
    if (Character != null) Character.Dispose();
  }

  private void FindBones() {
    var found = new List<Transform>();
    var names = new List<string>();
    foreach (var below in GetComponentsInChildren<Transform>()) {
      if (Character.FindBone(below.name) < 0) continue;
      found.Add(below);
      names.Add(below.name);
    }
    if (found.Count == 0) throw new UnityException(name + ": none of the objects below it is named as a policy's bone");
    bones = found.ToArray();
    pose = new Fm.Transform[bones.Length];
    rig = new Fm.Rig(Character, names.ToArray());
    isHips = new bool[bones.Length];
    isTop = new bool[bones.Length];
    for (int i = 0; i < bones.Length; ++i) {
      isHips[i] = rig.Bone(i) == Character.Info.Hips;
      isTop[i] = Character.Bone(rig.Bone(i)).Parent < 0;
    }
  }

  private void Update() {
    var forward = view == null ? Vector3.forward : view.forward;
    var pushed = new Numerics.Vector2(stick.x, stick.y);
    Player.Step(Fm.Input.ByCamera(pushed, From(forward), jump), Time.deltaTime);
    Go();
    int count = Player.Events(events);
    for (int i = 0; i < count && Happened != null; ++i) Happened(events[i]);
  }

  // After animators, so that what they write to the same bones does not count.
  private void LateUpdate() {
    Player.Pose(pose, Fm.Space.Local, rig);
    for (int i = 0; i < bones.Length; ++i) {
      var rotation = From(pose[i].Rotation);
      if (isTop[i]) {  // which has the model for its parent
        bones[i].SetPositionAndRotation(transform.TransformPoint(From(pose[i].Position)), transform.rotation * rotation);
      } else {
        bones[i].localRotation = rotation;
        if (isHips[i]) bones[i].localPosition = From(pose[i].Position);
      }
    }
  }

  private void Go() {
    var place = Player.State.Place;
    var to = From(place.Position);
    if (controller != null) {
      controller.Move(to - transform.position);
      place.Position = From(transform.position);
      Player.MoveTo(place);
    } else {
      transform.position = to;
    }
    transform.rotation = From(Player.State.Rotation);
  }

  private bool Below(Numerics.Vector3 from, out Fm.GroundHit hit) {
    RaycastHit struck;
    bool any = Physics.Raycast(From(from), Vector3.down, out struck, Mathf.Infinity, ground.value);
    hit = any ? new Fm.GroundHit { Height = struck.point.y, Normal = From(struck.normal) } : new Fm.GroundHit();
    return any;
  }

  private static Vector3 From(Numerics.Vector3 v) { return new Vector3(v.X, v.Y, v.Z); }
  private static Numerics.Vector3 From(Vector3 v) { return new Numerics.Vector3(v.x, v.y, v.z); }
  private static Quaternion From(Numerics.Quaternion q) { return new Quaternion(q.X, q.Y, q.Z, q.W); }
}
