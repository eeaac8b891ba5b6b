/** The sun and the sky: one for all materials, so that figures, walls and floors belong together. */

import { Color, Vector2, Vector3, type Texture } from "three";
import type { Theme } from "./scene";

/** Towards the sun: from the front left of the overview, 52 degrees high. */
export const SUN = new Vector3(-0.5, -0.36, 0.79).normalize();

export interface LightUniforms {
  readonly sunDirection: { value: Vector3 };
  readonly sunColour: { value: Color };
  readonly skyColour: { value: Color };
  readonly earthColour: { value: Color };
  /** Sunlight and openness of the ground (shade.ts), and the rectangle that it covers. */
  readonly shadeMap: { value: Texture | null };
  readonly shadeOrigin: { value: Vector2 };
  readonly shadeSize: { value: Vector2 };
}

export function lightUniforms(): LightUniforms {
  return {
    sunDirection: { value: SUN },
    sunColour: { value: new Color() },
    skyColour: { value: new Color() },
    earthColour: { value: new Color() },
    shadeMap: { value: null },
    shadeOrigin: { value: new Vector2() },
    shadeSize: { value: new Vector2(1, 1) },
  };
}

/** A floor in the sun comes out in its own colour: sky and sun add up to one on it. */
export function setLight(light: LightUniforms, theme: Theme): void {
  const dark = theme === "dark";
  const sky = light.skyColour.value;
  const earth = light.earthColour.value;
  if (dark) {
    sky.setRGB(0.56, 0.58, 0.64);
    earth.setRGB(0.36, 0.36, 0.4);
  } else {
    sky.setRGB(0.54, 0.56, 0.6);
    earth.setRGB(0.44, 0.4, 0.36);
  }
  light.sunColour.value.setRGB((1 - sky.r) / SUN.z, (1 - sky.g) / SUN.z, (1 - sky.b) / SUN.z);
}

/** GLSL: `lit(albedo, normal, sun)` and `shadeAt(place)`, the sunlight and the openness at a place of the ground. */
export const LIGHT_GLSL = /* glsl */ `
uniform vec3 sunDirection, sunColour, skyColour, earthColour;
uniform sampler2D shadeMap;
uniform vec2 shadeOrigin, shadeSize;
vec3 lit(vec3 albedo, vec3 normal, float sun) {
  vec3 sky = mix(earthColour, skyColour, normal.z * 0.5 + 0.5);
  return albedo * (sky + sunColour * (max(dot(normal, sunDirection), 0.0) * sun));
}
vec2 shadeAt(vec2 place) {
  vec2 uv = (place - shadeOrigin) / shadeSize;
  return textureLod(shadeMap, uv, 0.0).rg;
}
`;
