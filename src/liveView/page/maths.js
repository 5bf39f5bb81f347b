// SPDX-License-Identifier: GPL-3.0-or-later
// Vectors are arrays of 3, matrices Float32Array of 16 by columns.
"use strict";
const vec = {
    add: (a, b) => [a[0] + b[0], a[1] + b[1], a[2] + b[2]],
    sub: (a, b) => [a[0] - b[0], a[1] - b[1], a[2] - b[2]],
    scale: (a, s) => [a[0] * s, a[1] * s, a[2] * s],
    dot: (a, b) => a[0] * b[0] + a[1] * b[1] + a[2] * b[2],
    cross: (a, b) => [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]],
    length: a => Math.hypot(a[0], a[1], a[2]),
    unit: a => vec.scale(a, 1 / (vec.length(a) || 1)),
    mix: (a, b, t) => a.map((x, i) => x + (b[i] - x) * t),
};

// Two unit vectors at right angles to a unit vector, and to each other.
function across(n) {
    const other = Math.abs(n[0]) < .9 ? [1, 0, 0] : [0, 1, 0];
    const u = vec.unit(vec.sub(other, vec.scale(n, vec.dot(other, n))));
    return [u, vec.cross(n, u)];
}

const matrix = {
    lookAt(eye, target, up) {
        const z = vec.unit(vec.sub(eye, target)), x = vec.unit(vec.cross(up, z)), y = vec.cross(z, x);
        return new Float32Array([x[0], y[0], z[0], 0, x[1], y[1], z[1], 0, x[2], y[2], z[2], 0, -vec.dot(x, eye), -vec.dot(y, eye), -vec.dot(z, eye), 1]);
    },
    perspective(tangent, aspect, near, far) {
        return new Float32Array([1 / (tangent * aspect), 0, 0, 0, 0, 1 / tangent, 0, 0, 0, 0, -(far + near) / (far - near), -1, 0, 0, -2 * far * near / (far - near), 0]);
    },
    orthographic(r, near, far) {
        return new Float32Array([1 / r, 0, 0, 0, 0, 1 / r, 0, 0, 0, 0, -2 / (far - near), 0, 0, 0, -(far + near) / (far - near), 1]);
    },
    multiply(a, b) {
        const m = new Float32Array(16);
        for (let c = 0; c < 4; ++c) for (let r = 0; r < 4; ++r) for (let k = 0; k < 4; ++k) m[4 * c + r] += a[4 * k + r] * b[4 * c + k];
        return m;
    },
};

// 1, 2 or 5 times a power of ten, at or below x.
function roundLength(x) {
    const power = 10 ** Math.floor(Math.log10(x));
    return power * (x >= 5 * power ? 5 : x >= 2 * power ? 2 : 1);
}

// A number with a prefix: 1.2 m for 0.0012 s is "1.20 ms".
function withPrefix(x, unit, digits = 3) {
    if (!Number.isFinite(x)) return "–";
    if (x === 0) return "0 " + unit;
    const steps = { "-4": "p", "-3": "n", "-2": "µ", "-1": "m", 0: "", 1: "k", 2: "M" };
    const step = Math.max(-4, Math.min(2, Math.floor(Math.log10(Math.abs(x) * (1 + 1e-12)) / 3)));
    const text = (x / 1000 ** step).toPrecision(digits);
    return (text.includes("e") ? String(+text) : text) + " " + steps[step] + unit;
}

// At most 4 digits, with a power where they would be many.
function shortNumber(x) {
    if (!Number.isFinite(x)) return "–";
    const size = Math.abs(x);
    return size !== 0 && (size < 1e-2 || size >= 1e5) ? x.toExponential(2).replace("e+", "e") : String(+x.toPrecision(4));
}
