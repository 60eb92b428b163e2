// SPDX-License-Identifier: MIT
// A character walks to where a stick points, turns, runs and jumps; its steps are told as they fall. Without a window:
//     mcs -out:example.exe ../Fragmotion.cs Example.cs -r:System.Numerics.dll && mono example.exe hero.policy
using System;
using System.IO;
using System.Numerics;
using Fragmotion;

static class Example {
  const double Frame = 1.0 / 60;
  static readonly Vector3 CameraForward = new Vector3(0, 0, -1);

  static int Main(string[] arguments) {
    if (arguments.Length != 1) {
      Console.Error.WriteLine("usage: example.exe FILE.policy");
      return 2;
    }
    try {
      using (var hero = Character.Load(File.ReadAllBytes(arguments[0])))
      using (var player = new Player(hero)) {
        Console.WriteLine("{0} bones, {1:F2} m tall", hero.Info.Bones, hero.Info.Height);
        Play(player, "walk away from the camera", new Vector2(0, 0.5f), 2, false);
        Play(player, "run to the right", new Vector2(1, 0), 2, false);
        Play(player, "jump", new Vector2(0.5f, 0), 1, true);
        Play(player, "stand", Vector2.Zero, 1, false);
      }
      return 0;
    } catch (FragmotionException failure) {
      Console.Error.WriteLine(failure.Message);
      return 1;
    }
  }

  static void Play(Player player, string what, Vector2 stick, double seconds, bool jumps) {
    var events = new Event[Player.MostEvents];
    Console.WriteLine(what);
    for (double time = 0; time < seconds; time += Frame) {
      player.Step(Input.ByCamera(stick, CameraForward, jumps), Frame);
      int count = player.Events(events);
      for (int i = 0; i < count; ++i) Console.WriteLine("  {0} at {1:F2}", events[i].Type, events[i].Position);
    }
    Console.WriteLine("  is at {0:F2}", player.State.Place.Position);
  }
}
