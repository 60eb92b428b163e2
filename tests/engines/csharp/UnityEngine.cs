// SPDX-License-Identifier: MIT
// As much of Unity's API as FragmotionCharacter.cs calls, so that it is compiled and played where there is no Unity:
// objects without scale in a tree, a controller that walks into a wall at x = `Wall`, and a slope.
using System;
using System.Collections.Generic;

namespace UnityEngine {

[AttributeUsage(AttributeTargets.Field)]
public sealed class TooltipAttribute : Attribute {
  public TooltipAttribute(string text) {}
}

public sealed class UnityException : Exception {
  public UnityException(string text) : base(text) {}
}

public static class Mathf {
  public const float Deg2Rad = (float)(Math.PI / 180), Infinity = float.PositiveInfinity;
}

public static class Time {
  public static float deltaTime = 1f / 60;
}

public struct Vector2 {
  public float x, y;
  public Vector2(float x, float y) { this.x = x; this.y = y; }
}

public struct Vector3 {
  public float x, y, z;
  public Vector3(float x, float y, float z) { this.x = x; this.y = y; this.z = z; }
  public static readonly Vector3 forward = new Vector3(0, 0, 1), up = new Vector3(0, 1, 0), down = new Vector3(0, -1, 0);
  public static Vector3 operator +(Vector3 a, Vector3 b) { return new Vector3(a.x + b.x, a.y + b.y, a.z + b.z); }
  public static Vector3 operator -(Vector3 a, Vector3 b) { return new Vector3(a.x - b.x, a.y - b.y, a.z - b.z); }
  public static Vector3 operator *(Vector3 a, float b) { return new Vector3(a.x * b, a.y * b, a.z * b); }
}

public struct Quaternion {
  public float x, y, z, w;
  public Quaternion(float x, float y, float z, float w) { this.x = x; this.y = y; this.z = z; this.w = w; }
  public static Quaternion operator *(Quaternion a, Quaternion b) {
    return new Quaternion(a.w * b.x + a.x * b.w + a.y * b.z - a.z * b.y, a.w * b.y - a.x * b.z + a.y * b.w + a.z * b.x,
                          a.w * b.z + a.x * b.y - a.y * b.x + a.z * b.w, a.w * b.w - a.x * b.x - a.y * b.y - a.z * b.z);
  }
  public static Vector3 operator *(Quaternion q, Vector3 v) {
    var turned = q * new Quaternion(v.x, v.y, v.z, 0) * new Quaternion(-q.x, -q.y, -q.z, q.w);
    return new Vector3(turned.x, turned.y, turned.z);
  }
}

public sealed class Transform {
  public string name;
  public Transform parent;
  public readonly List<Transform> children = new List<Transform>();
  public Vector3 localPosition, eulerAngles;
  public Quaternion localRotation = new Quaternion(0, 0, 0, 1);

  public Vector3 forward { get { return rotation * Vector3.forward; } }
  public Vector3 position {
    get { return parent == null ? localPosition : parent.TransformPoint(localPosition); }
    set { localPosition = parent == null ? value : parent.Inverse(value); }
  }
  public Quaternion rotation {
    get { return parent == null ? localRotation : parent.rotation * localRotation; }
    set { localRotation = parent == null ? value : Conjugate(parent.rotation) * value; }
  }
  public Vector3 TransformPoint(Vector3 point) { return position + rotation * point; }
  public void SetPositionAndRotation(Vector3 place, Quaternion turn) {
    position = place;
    rotation = turn;
  }
  private Vector3 Inverse(Vector3 point) { return Conjugate(rotation) * (point - position); }
  private static Quaternion Conjugate(Quaternion q) { return new Quaternion(-q.x, -q.y, -q.z, q.w); }
}

public class MonoBehaviour {
  public string name = "character";
  public readonly Transform transform = new Transform();
  public IEnumerable<T> GetComponentsInChildren<T>() where T : class { return All<T>(transform); }
  private static IEnumerable<T> All<T>(Transform top) where T : class {
    yield return top as T;
    foreach (var child in top.children) {
      foreach (var below in All<T>(child)) yield return below;
    }
  }
}

public sealed class TextAsset {
  public byte[] bytes;
}

public struct LayerMask {
  public int value;
}

public sealed class CharacterController {
  public Transform transform;
  public const float Wall = 0.5f;
  public void Move(Vector3 motion) {
    var to = transform.position + motion;
    transform.position = new Vector3(Math.Min(to.x, Wall), to.y, to.z);
  }
}

public struct RaycastHit {
  public Vector3 point, normal;
}

public static class Physics {
  public const float Slope = 0.2f;
  public static bool Raycast(Vector3 origin, Vector3 direction, out RaycastHit hit, float distance, int layers) {
    hit = new RaycastHit { point = new Vector3(origin.x, Slope * origin.z, origin.z), normal = new Vector3(0, 1, -Slope) };
    return direction.y < 0 && origin.y >= hit.point.y && origin.y - hit.point.y <= distance && layers != 0;
  }
}

}  // namespace UnityEngine
