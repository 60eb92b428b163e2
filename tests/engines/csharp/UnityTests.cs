// SPDX-License-Identifier: MIT
// Plays games/csharp/Unity's component on a tree of objects, as Unity would call it, with the stand-in for its API.
using System;
using System.Collections.Generic;
using System.IO;
using System.Linq;
using System.Reflection;
using UnityEngine;
using Fm = Fragmotion;

static class UnityTests {
  static byte[] policy;

  static int Main(string[] arguments) {
    policy = File.ReadAllBytes(arguments[0]);
    Check("BonesAreWhereThePoseHasThem", BonesAreWhereThePoseHasThem());
    Check("WallsAndSlopesCount", WallsAndSlopesCount());
    Check("WhatHappensIsTold", WhatHappensIsTold());
    return 0;
  }

  static void Check(string name, bool holds) { Console.WriteLine("{0} {1}", holds ? "passed" : "failed", name); }

  static FragmotionCharacter Made(Action<FragmotionCharacter> settings) {
    var made = new FragmotionCharacter { policy = new TextAsset { bytes = policy } };
    using (var hero = Fm.Character.Load(policy, Fm.Axes.Unity)) {
      var armature = Below(made.transform, "Armature");
      var objects = new List<Transform>();
      for (int i = 0; i < hero.Info.Bones; ++i) {
        var bone = hero.Bone(i);
        objects.Add(Below(bone.Parent < 0 ? armature : objects[bone.Parent], "Armature:" + bone.Name));
        var rest = bone.Rest.Position;
        objects[i].localPosition = new Vector3(rest.X, rest.Y, rest.Z);
      }
    }
    settings(made);
    Call(made, "Awake");
    return made;
  }

  static Transform Below(Transform parent, string name) {
    var made = new Transform { name = name, parent = parent };
    parent.children.Add(made);
    return made;
  }

  static void Call(FragmotionCharacter character, string message) {
    typeof(FragmotionCharacter).GetMethod(message, BindingFlags.Instance | BindingFlags.NonPublic).Invoke(character, null);
  }

  static void Play(FragmotionCharacter character, int frames, float x, float y) {
    character.stick = new Vector2(x, y);
    for (int i = 0; i < frames; ++i) {
      Call(character, "Update");
      Call(character, "LateUpdate");
    }
  }

  static bool BonesAreWhereThePoseHasThem() {
    var character = Made(made => {});
    Play(character, 100, 0.3f, 0.4f);
    var world = new Fm.Transform[character.Character.Info.Bones];
    character.Player.Pose(world, Fm.Space.World);
    var bones = character.GetComponentsInChildren<Transform>().Where(each => (each.name ?? "").Contains(":")).ToList();
    var errors = bones.Select(bone => {
      var wanted = world[character.Character.FindBone(bone.name)].Position;
      return (new System.Numerics.Vector3(bone.position.x, bone.position.y, bone.position.z) - wanted).Length();
    });
    bool right = bones.Count == world.Length && errors.Max() < 1e-5;
    Call(character, "OnDestroy");
    return right;
  }

  static bool WallsAndSlopesCount() {
    var character = Made(made => {
      made.ground = new LayerMask { value = 1 };
      made.controller = new CharacterController { transform = made.transform };
    });
    Play(character, 300, 0.5f, 0.5f);
    var at = character.transform.position;
    Call(character, "OnDestroy");
    return Math.Abs(at.x - CharacterController.Wall) < 1e-6 && at.z > 2 && Math.Abs(at.y - Physics.Slope * at.z) < 0.1;
  }

  static bool WhatHappensIsTold() {
    int steps = 0;
    var character = Made(made => made.Happened += what => steps += what.Type == Fm.EventType.FootDown ? 1 : 0);
    Play(character, 240, 0, 0.5f);
    Call(character, "OnDestroy");
    return steps >= 4;
  }
}
