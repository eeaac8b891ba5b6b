/** How everything solid of the place is lit. */

import { ShaderMaterial } from "three";
import { LIGHT_GLSL, type LightUniforms } from "./light";

const VERTEX = /* glsl */ `
${LIGHT_GLSL}
varying vec3 shade;
attribute vec3 color;
void main() {
  // Less sky near the ground.
  float open = 0.84 + 0.16 * smoothstep(0.0, 1.2, position.z);
  shade = lit(color, normal, 1.0) * open;
  gl_Position = projectionMatrix * viewMatrix * vec4(position, 1.0);
}
`;

const FRAGMENT = /* glsl */ `
varying vec3 shade;
uniform float heat;
void main() {
  gl_FragColor = vec4(mix(shade, vec3(dot(shade, vec3(0.3, 0.5, 0.2))), 0.75 * heat), 1.0);
  #include <colorspace_fragment>
}
`;

export function solidMaterial(light: LightUniforms, heat: { value: number }): ShaderMaterial {
  return new ShaderMaterial({ uniforms: { ...light, heat }, vertexShader: VERTEX, fragmentShader: FRAGMENT });
}
