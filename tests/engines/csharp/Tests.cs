// SPDX-License-Identifier: MIT
// The tests of games/csharp: each prints "passed NAME" or "failed NAME: why"; `poses` prints the sum of the poses that
// tests/game/consumer.c shows. Arguments: a policy file of a walking character, and one with moves and styles.
using System;
using System.Collections.Generic;
using System.IO;
using System.Linq;
using System.Numerics;
using System.Reflection;
using System.Threading;
using Fragmotion;

static class Tests {
  const double Frame = 1.0 / 60;
  static byte[] walking, moving;

  static int Main(string[] arguments) {
    walking = File.ReadAllBytes(arguments[0]);
    if (arguments.Length == 1) {
      Console.WriteLine("{0:x16}", SumOfPoses());
      return 0;
    }
    moving = File.ReadAllBytes(arguments[1]);
    int failures = 0;
    foreach (var test in typeof(Promises).GetMethods(BindingFlags.Static | BindingFlags.Public)) {
      try {
        test.Invoke(null, null);
        Console.WriteLine("passed {0}", test.Name);
      } catch (TargetInvocationException failure) {
        ++failures;
        Console.WriteLine("failed {0}: {1}", test.Name, failure.InnerException);
      }
    }
    return failures == 0 ? 0 : 1;
  }

  static unsafe ulong SumOfPoses() {
    ulong hash = 14695981039346656037;
    using (var hero = Character.Load(walking, Axes.Blender))
    using (var player = new Player(hero)) {
      var pose = new Transform[hero.Info.Bones];
      for (int frame = 0; frame < 600; ++frame) {
        int part = frame / 45;
        player.Step(Input.ByCharacter(part * 7 % 5 - 2, part * 11 % 7 - 2, part * 5 % 3 - 1, part % 6 == 5), (float)(1.0 / 60));
        player.Pose(pose, Space.World);
        fixed (Transform* transforms = pose) {
          var bytes = (byte*)transforms;
          for (int i = 0; i < pose.Length * sizeof(Transform); ++i) hash = (hash ^ bytes[i]) * 1099511628211;
        }
      }
    }
    return hash;
  }

  static void Expect(bool holds, string what) {
    if (!holds) throw new Exception("not so: " + what);
  }

  static FragmotionException Refused(Action action) {
    try {
      action();
    } catch (FragmotionException failure) {
      return failure;
    }
    throw new Exception("it was not refused");
  }

  static void Walk(Player player, int frames, float forward = 1.2f) {
    for (int i = 0; i < frames; ++i) player.Step(Input.ByCharacter(0, forward), Frame);
  }

  static class Promises {
    public static void TheCharacterIsToldAsItIs() {
      using (var hero = Character.Load(moving)) {
        Expect(hero.Info.Bones > 10 && hero.Info.Moves > 0 && hero.Info.Styles > 1, "bones, moves and styles");
        Expect(Enumerable.Range(0, hero.Info.Bones).All(i => hero.FindBone(hero.Bone(i).Name) == i), "bones by names");
        Expect(hero.Bone(hero.Info.Hips).Role == Role.Hips && hero.Bone(0).Parent == -1, "the hips and the first bone");
        Expect(hero.FindMove(hero.Move(0).Name) == 0 && hero.Move(0).Seconds > 0.1f, "a move");
        var style = hero.Style(hero.Info.Styles - 1);
        Expect(hero.FindStyle(style.Name) == hero.Info.Styles - 1 && style.Classes > 5, "a style");
        Expect(style.Speeds.Length >= 1 && style.Speeds.Contains(style.Walk) && style.Walk > 0.2f, "its speeds");
        Expect(style.Run >= style.Walk && style.TurnRate > 0, "its run and turn rate");
        Expect(hero.ClassName(0, 0).Length > 2, "a class's name");
        Expect(hero.FindBone("Ärmel") == -1, "no such bone");
        Expect(Library.Version == "0.1.0", "the version");
      }
    }

    public static void WhatFailsSaysWhatWasWrong() {
      var failure = Refused(() => Character.Load(new byte[] { 1, 2, 3 }));
      Expect(failure.Result == Result.Refused && failure.Message.Contains("no Fragmotion policy file"), failure.Message);
      using (var hero = Character.Load(walking))
      using (var player = new Player(hero)) {
        Expect(Refused(() => player.Step(new Input { Turn = float.NaN }, Frame)).Result == Result.Argument, "no number");
        Expect(Refused(() => player.Step(new Input(), -1)).Message.Length > 20, "words");
        Expect(Refused(() => player.StartMove(7)).Result == Result.Argument, "no such move");
        Expect(Refused(() => player.Pose(new Transform[1], Space.Local)).Result == Result.Capacity, "too few bones");
        Expect(Refused(() => hero.ClassName(0, 100000)).Result == Result.Argument, "no such class");
        Expect(Refused(() => player.Save(new byte[10])).Result == Result.Capacity, "too few bytes");
      }
    }

    public static void StructsAreAsLargeAsTheLibrarys() {
      using (var hero = Character.Load(walking))
      using (var player = new Player(hero)) {
        Expect(player.Options.Seed == 1 && player.Options.HoldFeet && player.Options.Stitch == 0.2, "options");
        var options = player.Options;
        options.TimeScale = 0;
        player.Options = options;
        Walk(player, 60);
        Expect(player.State.Place.Position == Vector3.Zero, "it pauses");
        options.CrossFades = true;
        using (var fading = new Player(hero, options)) Expect(fading.Options.CrossFades, "it cross-fades");
      }
    }

    public static void ItGoesWhereItIsAskedTo() {
      using (var hero = Character.Load(walking))
      using (var player = new Player(hero)) {
        for (int i = 0; i < 180; ++i) player.Step(Input.ByCamera(new Vector2(0.5f, 0), new Vector3(0, 0, -1)), Frame);
        Expect(player.State.Place.Position.X > 1 && Math.Abs(player.State.Place.Heading + Math.PI / 2) < 0.3, "right");
        player.Reset();
        for (int i = 0; i < 180; ++i) player.Step(Input.ByWorld(new Vector3(0, 0, 1.2f), new Vector3(0, 0, 1)), Frame);
        Expect(player.State.Place.Position.Z > 1, "backward in the world");
        player.MoveTo(new Place { Position = new Vector3(5, 6, 7) });
        Expect(player.State.Place.Position == new Vector3(5, 6, 7), "moved");
        var places = new Place[10];
        player.Foresee(Input.ByWorld(new Vector3(0, 0, 1.2f), new Vector3(0, 0, 1)), 2, places);
        Expect(places[9].Position.Z > 7.5f && player.State.Place.Position.Z == 7, "foreseen, not gone");
      }
    }

    public static void EventsAreToldInTheirOrder() {
      using (var hero = Character.Load(walking))
      using (var player = new Player(hero)) {
        var events = new Event[Player.MostEvents];
        var feet = new List<int>();
        for (int i = 0; i < 240; ++i) {
          Walk(player, 1);
          int count = player.Events(events);
          for (int k = 0; k < count; ++k) {
            if (events[k].Type == EventType.FootDown) feet.Add(events[k].Index);
          }
        }
        Expect(feet.Count > 4, "steps");
        Expect(Enumerable.Range(1, feet.Count - 1).All(i => feet[i] != feet[i - 1]), "left and right in turn");
      }
    }

    public static void MovesAndStylesPlay() {
      using (var hero = Character.Load(moving))
      using (var player = new Player(hero)) {
        var events = new Event[Player.MostEvents];
        var seen = new HashSet<EventType>();
        player.StartMove(0);
        player.ChangeStyle(1);
        for (int i = 0; i < 240; ++i) {
          if (i == 60) player.ReleaseMove(0);
          Walk(player, 1);
          int count = player.Events(events);
          for (int k = 0; k < count; ++k) seen.Add(events[k].Type);
        }
        Expect(seen.IsSupersetOf(new[] { EventType.MoveBegins, EventType.StyleChanges }), string.Join(" ", seen));
        Expect(player.State.Style == 1, "the style");
      }
    }

    public static void TheRigIsInTheGamesOrder() {
      using (var hero = Character.Load(walking))
      using (var player = new Player(hero)) {
        int bones = hero.Info.Bones;
        var names = Enumerable.Range(0, bones).Select(i => "Armature|" + hero.Bone(bones - 1 - i).Name).ToArray();
        using (var rig = new Rig(hero, names)) {
          Walk(player, 30);
          var own = new Transform[bones];
          var mine = new Transform[bones];
          player.Pose(own, Space.Local);
          player.Pose(mine, Space.Local, rig);
          Expect(Enumerable.Range(0, bones).All(i => rig.Bone(i) == bones - 1 - i), "found by names");
          Expect(own.Reverse().SequenceEqual(mine), "the same, backward");
          var matrices = new float[16 * bones];
          player.Skinning(matrices, Space.Model, rig);
          Expect(matrices.All(number => Math.Abs(number) < 10) && matrices[15] == 1, "matrices");
          Library.Blend(own, own, 0.5f, null, mine);
          Expect(Enumerable.Range(0, bones).All(i => (own[i].Position - mine[i].Position).Length() < 1e-6), "blended");
        }
      }
    }

    public static void RollbackIsToTheBit() {
      using (var hero = Character.Load(walking))
      using (var player = new Player(hero))
      using (var other = new Player(hero)) {
        Walk(player, 40);
        var bytes = new byte[player.SaveSize];
        int size = player.Save(bytes);
        Walk(player, 60, 3);
        other.Restore(bytes, size);
        Walk(other, 60, 3);
        Expect(player.Checksum == other.Checksum, "equal");
        Walk(other, 1);
        Expect(player.Checksum != other.Checksum, "and no longer");
        bytes[size / 2] ^= 255;
        Expect(Refused(() => other.Restore(bytes, size)).Result == Result.Refused, "a state that was changed");
      }
    }

    public static void PathsLeadToTheirEnd() {
      using (var hero = Character.Load(walking))
      using (var player = new Player(hero)) {
        player.SetPath(new WalkPath { Points = new[] { Vector3.Zero, new Vector3(0, 0, -3), new Vector3(2, 0, -5) } });
        for (int i = 0; i < 600 && !player.State.PathArrived; ++i) player.Step(Input.ByPath(), Frame);
        Expect((player.State.Place.Position - new Vector3(2, 0, -5)).Length() < 0.5f, "there");
        player.SetPath(null);
        Expect(!player.State.PathArrived, "forgotten");
      }
    }

    public static void TheGroundIsAskedAndItsFailuresComeOut() {
      using (var hero = Character.Load(walking))
      using (var player = new Player(hero)) {
        player.SetGround((Vector3 from, out GroundHit hit) => {
          hit = new GroundHit { Height = -0.2f * from.Z, Normal = new Vector3(0, 1, 0.2f) };
          return true;
        });
        GC.Collect();
        GC.WaitForPendingFinalizers();
        Walk(player, 240);
        var at = player.State.Place.Position;
        Expect(at.Z < -2 && Math.Abs(at.Y + 0.2f * at.Z) < 0.1f, "on the slope: " + at);
        player.SetGround((Vector3 from, out GroundHit hit) => { throw new InvalidOperationException("no ground today"); });
        try {
          Walk(player, 1);
          Expect(false, "it threw");
        } catch (InvalidOperationException failure) {
          Expect(failure.Message == "no ground today" && failure.StackTrace.Contains("Tests"), "the game's own words");
        }
        player.SetGround(null);
        Walk(player, 10);
      }
    }

    public static void ACrowdPlaysWhatItsPlayersWouldAlone() {
      using (var hero = Character.Load(walking))
      using (var crowd = new Crowd(hero, 12, 3)) {
        var inputs = Enumerable.Range(0, 12).Select(i => Input.ByCharacter(0, 0.25f * i)).ToArray();
        for (int frame = 0; frame < 60; ++frame) {
          var jobs = Enumerable.Range(0, 3).Select(part => new Thread(() => crowd.StepPart(part, inputs, Frame))).ToList();
          jobs.ForEach(job => job.Start());
          jobs.ForEach(job => job.Join());
        }
        var options = PlayerOptions.Default;
        options.Seed = 1 + 7;
        using (var alone = new Player(hero, options)) {
          for (int frame = 0; frame < 60; ++frame) alone.Step(inputs[7], Frame);
          Expect(crowd.Count == 12 && alone.Checksum == crowd[7].Checksum, "equal");
        }
      }
    }

    public static void ACrowdGoesAroundWhoStandsInItsWay() {
      using (var hero = Character.Load(walking))
      using (var crowd = new Crowd(hero, 1)) {
        var post = new Body { Position = new Vector3(0, 0, 3), Radius = 0.3f };
        var inputs = new[] { Input.ByWorld(new Vector3(0, 0, 1.3f), Vector3.UnitZ) };
        float nearest = 3;
        for (int frame = 0; frame < 240; ++frame) {
          crowd.MakeWay(0.4f, Frame, post);
          crowd.Step(inputs, Frame);
          nearest = Math.Min(nearest, Vector3.Distance(crowd[0].State.Place.Position, post.Position));
        }
        Expect(nearest > 0.5f && nearest < 1.5f, "clear of the post and beside it: " + nearest);
        Expect(crowd[0].State.Place.Position.Z > 4, "behind it: " + crowd[0].State.Place.Position);
        crowd.MakeWay(0.4f, Frame);
        Refused(() => crowd.MakeWay(-1, Frame));
      }
    }

    public static void WhatIsReleasedInAnyOrderHarmsNothing() {
      var hero = Character.Load(walking);
      var player = new Player(hero);
      var crowd = new Crowd(hero, 3);
      var one = crowd[1];
      hero.Dispose();
      crowd.Dispose();
      Walk(player, 30);
      player.Dispose();
      player.Dispose();
      foreach (var released in new[] { player, one }) {
        try {
          Walk(released, 1);
          Expect(false, "it threw");
        } catch (ObjectDisposedException) {
        }
      }
      Abandon();
      GC.Collect();
      GC.WaitForPendingFinalizers();
    }

    static void Abandon() {
      for (int i = 0; i < 20; ++i) {
        var hero = Character.Load(walking);
        var crowd = new Crowd(hero, 2);
        crowd[0].SetGround((Vector3 from, out GroundHit hit) => { hit = new GroundHit(); return false; });
        crowd.Step(new Input[2], Frame);
        Walk(new Player(hero), 1);
      }
    }

    public static void AStepAllocatesNothing() {
      using (var hero = Character.Load(walking))
      using (var player = new Player(hero)) {
        var pose = new Transform[hero.Info.Bones];
        var events = new Event[Player.MostEvents];
        var bytes = new byte[player.SaveSize];
        Action frame = () => {
          player.Step(Input.ByCharacter(0, 1), Frame);
          player.Pose(pose, Space.Local);
          player.Events(events);
          player.Restore(bytes, player.Save(bytes));
        };
        frame();
        GC.Collect();
        int collections = GC.CollectionCount(0);
        for (int i = 0; i < 20000; ++i) frame();
        Expect(GC.CollectionCount(0) == collections, "no collection in 20,000 frames");
      }
    }
  }
}
