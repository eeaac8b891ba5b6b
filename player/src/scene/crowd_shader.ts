/** The shaders of the crowd: skinning from the pose table, colours by person, and the same flattened to a shadow. */

import { LIGHT_GLSL } from "./light";
import { PAINTS } from "./loft";
import { BIND, JOINTS } from "./skeleton";

/** A byte of 0 stands for so much, 255 for one more. */
export const LEAST_GIRTH = 0.7;

const decimal = (n: number): string => n.toFixed(4);
const bind = JOINTS.map((joint) => `vec3(${BIND[joint].map(decimal).join(", ")})`).join(", ");
const paint = (name: (typeof PAINTS)[number]): string => `${PAINTS.indexOf(name)}`;

const SKINNING_GLSL = /* glsl */ `
attribute vec4 skin;      // joint, other joint, share of the other, paint
attribute vec2 extra;     // part or -1, shade
attribute vec4 place;     // x, y, then where the figure's x axis points, as long as the figure is tall
attribute vec4 poseA;     // two rows, share of the second, 1 with a stool
attribute vec4 poseB;     // two rows, share of the second, share of pose A
attribute vec4 manner;    // yaw of the head, lift, presence, dimming
attribute vec4 shirtAttr; // colour, parts
attribute vec4 legsAttr;  // colour, long sleeves
attribute vec4 skinAttr;  // colour, girth
attribute vec4 hairAttr;  // colour, shoes
uniform highp sampler2D poses;
const vec3 BIND[${JOINTS.length}] = vec3[](${bind});

vec4 texel(int column, float row) { return texelFetch(poses, ivec2(column, int(row)), 0); }
vec4 toward(vec4 a, vec4 b, float share) { return normalize(mix(a, dot(a, b) < 0.0 ? -b : b, share)); }

void joint(int j, out vec4 turn, out vec4 at) {
#ifdef FINE
  turn = toward(texel(2 * j, poseA.x), texel(2 * j, poseA.y), poseA.z);
  at = mix(texel(2 * j + 1, poseA.x), texel(2 * j + 1, poseA.y), poseA.z);
  if (poseB.w < 1.0) {
    vec4 turnB = toward(texel(2 * j, poseB.x), texel(2 * j, poseB.y), poseB.z);
    vec4 atB = mix(texel(2 * j + 1, poseB.x), texel(2 * j + 1, poseB.y), poseB.z);
    turn = toward(turnB, turn, poseB.w);
    at = mix(atB, at, poseB.w);
  }
#else
  float row = poseA.z < 0.5 ? poseA.x : poseA.y;
  turn = texel(2 * j, row);
  at = texel(2 * j + 1, row);
  if (poseB.w < 1.0) {
    float rowB = poseB.z < 0.5 ? poseB.x : poseB.y;
    turn = toward(texel(2 * j, rowB), turn, poseB.w);
    at = mix(texel(2 * j + 1, rowB), at, poseB.w);
  }
#endif
}

vec3 rotated(vec4 q, vec3 v) { return v + 2.0 * cross(q.xyz, cross(q.xyz, v) + q.w * v); }
vec2 spun(vec2 v, float angle) {
  float s = sin(angle), c = cos(angle);
  return vec2(c * v.x - s * v.y, s * v.x + c * v.y);
}

void bone(int j, out vec3 at, out vec3 direction) {
  vec4 turn, origin;
  joint(j, turn, origin);
  vec3 v = (position - BIND[j]) * origin.w;
  if (j < ${JOINTS.indexOf("book")}) v.xy *= skinAttr.a + ${LEAST_GIRTH};
  if (j == ${JOINTS.indexOf("stool")}) v *= poseA.w;
  vec3 n = normal;
  if (j == ${JOINTS.indexOf("head")}) {
    v.xy = spun(v.xy, manner.x);
    n.xy = spun(n.xy, manner.x);
  }
  at = rotated(turn, v) + origin.xyz;
  direction = rotated(turn, n);
}

bool shown() {
  int part = int(extra.x);
  return manner.z > 0.0 && (part < 0 || ((int(shirtAttr.w * 255.0 + 0.5) >> part) & 1) == 1);
}

void figure(out vec3 at, out vec3 direction) {
  bone(int(skin.x), at, direction);
#ifdef FINE
  if (skin.z > 0.0) {
    vec3 otherAt, otherDirection;
    bone(int(skin.y), otherAt, otherDirection);
    at = mix(at, otherAt, skin.z);
    direction = normalize(mix(direction, otherDirection, skin.z));
  }
#endif
  float size = length(place.zw);
  mat2 heading = mat2(place.z, place.w, -place.w, place.z);
  at = vec3(heading * at.xy + place.xy, at.z * size + manner.y);
  direction.xy = heading * direction.xy / size;
}
`;

export const CROWD_VERTEX = /* glsl */ `
${LIGHT_GLSL}
${SKINNING_GLSL}
uniform vec3 mist;
varying vec3 colour;
varying float presence;

vec3 painted() {
  int paint = int(skin.w);
  if (paint == ${paint("skin")}) return skinAttr.rgb;
  if (paint == ${paint("shirt")}) return shirtAttr.rgb;
  if (paint == ${paint("trousers")}) return legsAttr.rgb;
  if (paint == ${paint("hair")}) return hairAttr.rgb;
  if (paint == ${paint("shoes")}) return mix(vec3(0.17, 0.145, 0.13), vec3(0.93, 0.92, 0.9), hairAttr.a);
  if (paint == ${paint("sleeve")}) return legsAttr.a > 0.5 ? shirtAttr.rgb : skinAttr.rgb;
  if (paint == ${paint("cover")}) return vec3(0.62, 0.25, 0.2);
  if (paint == ${paint("paper")}) return vec3(0.97, 0.955, 0.92);
  if (paint == ${paint("screen")}) return vec3(0.1, 0.11, 0.13);
  if (paint == ${paint("card")}) return vec3(0.78, 0.6, 0.4);
  if (paint == ${paint("wood")}) return vec3(0.76, 0.61, 0.44);
  return mix(legsAttr.rgb, hairAttr.rgb, 0.35);
}

void main() {
  presence = manner.z;
  if (!shown()) {
    gl_Position = vec4(2.0, 2.0, 2.0, 1.0);
    return;
  }
  vec3 at, direction;
  figure(at, direction);
  // From sRGB, near enough.
  vec3 albedo = painted();
  albedo *= albedo * (albedo * 0.305 + 0.682) + 0.0125;
  float sun = shadeAt(place.xy).r;
  // Less sky from below: the ground and the figure itself are in its way.
  float open = extra.y * (0.8 + 0.2 * smoothstep(0.0, 0.9, at.z));
  colour = lit(albedo, direction, sun * (0.25 + 0.75 * extra.y)) * open * 1.06;
  // A little sky from behind sets the outline off.
  float rim = 1.0 - max(dot(direction, normalize(cameraPosition - at)), 0.0);
  colour += skyColour * (0.16 * rim * rim * rim) * (0.35 + albedo);
  colour = mix(colour, mist, manner.w);
  gl_Position = projectionMatrix * viewMatrix * vec4(at, 1.0);
}
`;

export const CROWD_FRAGMENT = /* glsl */ `
varying vec3 colour;
varying float presence;
void main() {
  // Coming and going: a fine raster that fills up.
  float raster = fract(52.9829189 * fract(dot(floor(gl_FragCoord.xy), vec2(0.06711056, 0.00583715))));
  if (presence < 1.0 && raster > presence) discard;
  gl_FragColor = vec4(colour, 1.0);
  #include <colorspace_fragment>
}
`;

export const SHADOW_VERTEX = /* glsl */ `
${LIGHT_GLSL}
${SKINNING_GLSL}
varying vec2 onGround;
varying float presence;
void main() {
  presence = manner.z * (1.0 - 0.6 * manner.w);
  if (!shown()) {
    gl_Position = vec4(2.0, 2.0, 2.0, 1.0);
    return;
  }
  vec3 at, direction;
  figure(at, direction);
  at.xy -= sunDirection.xy / sunDirection.z * max(at.z, 0.0);
  onGround = at.xy;
  gl_Position = projectionMatrix * viewMatrix * vec4(at.xy, 0.0, 1.0);
}
`;

/** Darkens only what the sun reaches: no shadow in a shadow. */
export const SHADOW_FRAGMENT = /* glsl */ `
${LIGHT_GLSL}
uniform vec4 shadow;
varying vec2 onGround;
varying float presence;
void main() {
  gl_FragColor = vec4(shadow.rgb, shadow.a * presence * smoothstep(0.15, 0.9, shadeAt(onGround).r));
}
`;
