// SPDX-License-Identifier: GPL-3.0-or-later
// GLSL. Lengths are spacings of the liquid's particles. "View" is the camera's frame, z against the line of sight.

const shaderParts = {
    light: `
uniform vec3 sun;               // towards it, view
uniform mat4 shadowMatrix;      // of view positions
uniform highp sampler2D shadowMap;
uniform float shadowDepth;      // how dark
float lit(vec3 at) {
    vec4 p = shadowMatrix*vec4(at, 1.); vec3 q = p.xyz*.5 + .5;
    if (any(lessThan(q.xy, vec2(0.))) || any(greaterThan(q.xy, vec2(1.)))) return 1.;
    float sum = 0., turn = fract(sin(dot(gl_FragCoord.xy, vec2(12.9898, 78.233)))*43758.5453)*6.2832;
    for (int i = 0; i < 16; ++i) {
        float r = sqrt((float(i) + .5)/16.), a = float(i)*2.39996 + turn;
        sum += texture(shadowMap, q.xy + r*.012*vec2(cos(a), sin(a))).r < q.z - .004 ? 0. : 1.;
    }
    return 1. - shadowDepth*(1. - sum/16.);
}
vec3 thetaColour(float theta) {
    float t = theta/180.;
    return t < .5 ? mix(vec3(.13, .45, .74), vec3(.88, .90, .91), t*2.) : mix(vec3(.88, .90, .91), vec3(.86, .42, .16), t*2. - 1.);
}
vec3 shade(vec3 colour, vec3 n, vec3 at, vec3 up, float shine) {
    float ambient = .55 + .12*dot(n, up), direct = max(dot(n, sun), 0.)*.42*lit(at);
    vec3 h = normalize(sun - normalize(at));
    return colour*(ambient + direct) + shine*pow(max(dot(n, h), 0.), 40.);
}`,
    particleVertex: `
layout(location = 0) in vec2 corner;
layout(location = 1) in vec4 place;     // 0 to 1 in the box, and the value
uniform vec3 low, size;
uniform mat4 view, projection;
uniform float radius;
out vec2 at; out vec3 centre; out float value;
void main() {
    centre = (view*vec4(low + place.xyz*size, 1.)).xyz;
    at = corner*1.06; value = place.w;
    gl_Position = projection*vec4(centre + vec3(at*radius, 0.), 1.);
}`,
    sphere: `
in vec2 at; in vec3 centre; in float value;
uniform mat4 projection; uniform float radius;
vec3 n, hit;
void findHit() {
    float r = dot(at, at);
    if (r > 1.) discard;
    n = vec3(at, sqrt(1. - r)); hit = centre + n*radius;
    vec4 clip = projection*vec4(hit, 1.);
    gl_FragDepth = clip.z/clip.w*.5 + .5;
}`,
    screenVertex: `
layout(location = 0) in vec2 corner;
out vec2 uv;
void main() { uv = corner*.5 + .5; gl_Position = vec4(corner, 0., 1.); }`,
};

const shaders = {
    particle: [shaderParts.particleVertex, shaderParts.sphere + shaderParts.light + `
uniform vec3 up; uniform int kind;      // 0 plain, 1 speed, 2 contact angle
out vec4 colour;
vec3 speedColour(float t) {
    vec3 a = vec3(.10, .32, .62), b = vec3(.16, .66, .76), c = vec3(.98, .86, .36), d = vec3(.90, .34, .17);
    return t < .333 ? mix(a, b, t*3.) : t < .667 ? mix(b, c, t*3. - 1.) : mix(c, d, t*3. - 2.);
}
void main() {
    findHit();
    vec3 base = kind == 0 ? vec3(.20, .52, .80) : kind == 1 ? speedColour(value) : thetaColour(value*180.);
    colour = vec4(shade(base, n, hit, up, kind == 2 ? .06 : .35), 1.);
}`],
    shadow: [shaderParts.particleVertex, shaderParts.sphere + `void main() { findHit(); }`],
    depth: [shaderParts.particleVertex, shaderParts.sphere + `out vec4 depth; void main() { findHit(); depth = vec4(-hit.z); }`],
    thickness: [shaderParts.particleVertex, shaderParts.sphere + `out vec4 thickness; void main() { findHit(); thickness = vec4(2.*n.z*radius); }`],

    // Walls: a vertex has a place, a normal and coordinates in its face.
    wall: [`
layout(location = 0) in vec3 position;
layout(location = 1) in vec3 normal;
uniform mat4 view, projection;
out vec3 at, n, world;
void main() {
    world = position; at = (view*vec4(position, 1.)).xyz; n = mat3(view)*normal;
    gl_Position = projection*vec4(at, 1.);
}`, `
in vec3 at, n, world;` + shaderParts.light + `
uniform vec3 up, across1, across2, middle;
uniform float theta, reach, grid, opacity;      // theta < 0: none
out vec4 colour;
float lines(float x, float width) { float d = abs(fract(x/grid - .5) - .5)*grid, w = fwidth(x); return 1. - smoothstep(width*w, (width + 1.)*w, d); }
void main() {
    vec3 base = theta < 0. ? vec3(.86, .89, .91) : mix(vec3(.88, .90, .92), thetaColour(theta), .36);
    vec3 m = normalize(n); if (dot(m, at) > 0.) m = -m;
    float fade = 1.;
    if (reach > 0.) {
        vec3 d = world - middle; float r = length(d);
        fade = 1. - smoothstep(.45*reach, reach, r);
        float u = dot(d, across1), v = dot(d, across2);
        base *= 1. - .11*max(lines(u, .4), lines(v, .4));
    }
    colour = vec4(shade(base, m, at, up, .04), fade*opacity);
}`],
    line: [`
layout(location = 0) in vec3 position;
uniform mat4 view, projection;
void main() { gl_Position = projection*view*vec4(position, 1.); }`, `out vec4 colour; void main() { colour = vec4(.30, .40, .48, .55); }`],
    sky: [shaderParts.screenVertex, `
in vec2 uv; out vec4 colour;
void main() { float r = length((uv - vec2(.45, .55))*vec2(1.1, 1.)); colour = vec4(mix(vec3(.955, .968, .978), vec3(.80, .85, .89), smoothstep(.1, .95, r)), 1.); }`],

    // The liquid's depth, smoothed along one direction where it does not jump.
    blur: [shaderParts.screenVertex, `
in vec2 uv; out vec4 depth;
uniform highp sampler2D source; uniform vec2 pixel, direction; uniform float width;     // width: pixels at depth 1
void main() {
    float middle = texture(source, uv).r;
    if (middle >= 1e4) { depth = vec4(middle); return; }
    float s = clamp(width/middle, 1., 16.), sum = middle, weight = 1.;
    for (int i = 1; i <= 32; ++i) {
        if (float(i) > 2.*s) break;
        float g = exp(-float(i*i)/(2.*s*s));
        vec2 step = direction*pixel*float(i);
        float a = texture(source, uv + step).r, b = texture(source, uv - step).r;
        float close = 2.2;
        if (abs(a - middle) < close && abs(b - middle) < close) { sum += g*(a + b); weight += 2.*g; }
        else { if (a - middle > -close && a < middle) { sum += g*a; weight += g; } if (b - middle > -close && b < middle) { sum += g*b; weight += g; } }
    }
    depth = vec4(sum/weight);
}`],
    // A Gaussian along one direction.
    soften: [shaderParts.screenVertex, `
in vec2 uv; out vec4 value;
uniform sampler2D source; uniform vec2 pixel, direction; uniform float width;
void main() {
    float sum = texture(source, uv).r, weight = 1., s = clamp(width, .5, 12.);
    for (int i = 1; i <= 24; ++i) {
        if (float(i) > 2.*s) break;
        float g = exp(-float(i*i)/(2.*s*s));
        vec2 step = direction*pixel*float(i);
        sum += g*(texture(source, uv + step).r + texture(source, uv - step).r); weight += 2.*g;
    }
    value = vec4(sum/weight);
}`],
    water: [shaderParts.screenVertex, `
in vec2 uv; out vec4 colour;
uniform highp sampler2D depths, thicknesses, background, backgroundDepth;
uniform vec2 pixel, tangent; uniform float aside; uniform vec3 sun, up, absorption; uniform mat4 projection; uniform mat3 toWorld;
vec3 place(vec2 at) { return vec3((at*2. - 1. + vec2(aside, 0.))*tangent, -1.)*texture(depths, at).r; }
vec3 sky(vec3 d) {
    vec3 c = mix(vec3(.22, .32, .40), vec3(.93, .97, 1.), smoothstep(-.25, .95, d.z));
    c += 1.5*smoothstep(.90, .95, dot(d, normalize(vec3(.35, -.55, .75))));
    c += .5*smoothstep(.80, .93, dot(d, normalize(vec3(-.75, .25, .6))));
    return c;
}
void main() {
    float z = texture(depths, uv).r;
    vec4 behind = texture(background, uv);
    colour = vec4(behind.rgb, 1.);
    float thick = texture(thicknesses, uv).r, covered = smoothstep(.9, 1.7, thick);
    if (z >= 1e4 || covered <= 0.) return;
    vec3 at = place(uv);
    vec4 clip = projection*vec4(at, 1.);
    if (clip.z/clip.w*.5 + .5 > texture(backgroundDepth, uv).r + 1e-5) return;
    vec2 x = vec2(2.*pixel.x, 0.), y = vec2(0., 2.*pixel.y);
    vec3 r = place(uv + x) - at, l = at - place(uv - x), t = place(uv + y) - at, b = at - place(uv - y);
    if (min(abs(r.z), abs(l.z)) > 4. || min(abs(t.z), abs(b.z)) > 4.) return;
    vec3 dx = abs(r.z) < abs(l.z) ? r : l, dy = abs(t.z) < abs(b.z) ? t : b;
    vec3 n = normalize(cross(dx, dy)), eye = normalize(-at);
    float facing = clamp(dot(n, eye), 0., 1.), fresnel = .02 + .98*pow(1. - facing, 5.)*smoothstep(1.2, 4., thick);
    vec2 shift = -n.xy*min(thick, 14.)*.085/(-at.z*tangent);
    vec2 from = clamp(uv + shift*.5, pixel, 1. - pixel);
    vec3 through = texture(background, from).rgb*exp(-absorption*thick);
    through += vec3(.05, .10, .13)*(1. - exp(-thick*.05));
    vec3 mirrored = sky(toWorld*reflect(-eye, n));
    float spark = pow(max(dot(n, normalize(sun + eye)), 0.), 260.)*1.6;
    vec3 water = mix(through, mirrored, fresnel) + spark;
    colour = vec4(mix(behind.rgb, water, covered), 1.);
}`],
    // Edges softened: as FXAA does it, with four neighbours.
    finish: [shaderParts.screenVertex, `
in vec2 uv; out vec4 colour;
uniform sampler2D source; uniform vec2 pixel;
float luma(vec3 c) { return dot(c, vec3(.299, .587, .114)); }
void main() {
    vec3 m = texture(source, uv).rgb;
    float a = luma(texture(source, uv + pixel*vec2(-1., -1.)).rgb), b = luma(texture(source, uv + pixel*vec2(1., -1.)).rgb);
    float c = luma(texture(source, uv + pixel*vec2(-1., 1.)).rgb), d = luma(texture(source, uv + pixel*vec2(1., 1.)).rgb), e = luma(m);
    float low = min(e, min(min(a, b), min(c, d))), high = max(e, max(max(a, b), max(c, d)));
    vec2 along = vec2(-((a + b) - (c + d)), (a + c) - (b + d));
    along = clamp(along/(min(abs(along.x), abs(along.y)) + max((a + b + c + d)*.03125, .0078)), -8., 8.)*pixel;
    vec3 near = .5*(texture(source, uv - along/6.).rgb + texture(source, uv + along/6.).rgb);
    vec3 wide = .5*near + .25*(texture(source, uv - along*.5).rgb + texture(source, uv + along*.5).rgb);
    float w = luma(wide);
    colour = vec4(w < low || w > high ? near : wide, 1.);
}`],
};
