// SPDX-License-Identifier: GPL-3.0-or-later
// Draws the liquid and the walls with WebGL 2, which every browser has. Lengths are spacings of the liquid's particles.

class Scene {
    constructor(canvas) {
        this.canvas = canvas;
        const gl = this.gl = canvas.getContext("webgl2", { antialias: false, alpha: false, powerPreference: "high-performance" });
        if (!gl) throw new Error("This browser has no WebGL 2");
        this.canSmooth = !!gl.getExtension("EXT_color_buffer_float");
        this.programs = {};
        for (const [name, [vertex, fragment]] of Object.entries(shaders)) this.programs[name] = this.program(vertex, fragment);
        this.square = this.buffer(new Float32Array([-1, -1, 1, -1, -1, 1, 1, 1]));
        this.liquid = this.particles();
        this.solid = this.particles();
        this.walls = [];
        this.look = this.canSmooth ? "water" : "plain";
        this.yaw = -.95; this.pitch = .30; this.distance = 60; this.target = [0, 0, 0];
        this.shadow = this.target2d(1024, 1024, null);
        this.isDue = true;
        this.listen();
    }

    program(vertex, fragment) {
        const gl = this.gl, head = "#version 300 es\nprecision highp float;\nprecision highp int;\n", program = gl.createProgram();
        for (const [type, text] of [[gl.VERTEX_SHADER, vertex], [gl.FRAGMENT_SHADER, fragment]]) {
            const shader = gl.createShader(type);
            gl.shaderSource(shader, head + text);
            gl.compileShader(shader);
            if (!gl.getShaderParameter(shader, gl.COMPILE_STATUS)) throw new Error(gl.getShaderInfoLog(shader));
            gl.attachShader(program, shader);
        }
        gl.linkProgram(program);
        if (!gl.getProgramParameter(program, gl.LINK_STATUS)) throw new Error(gl.getProgramInfoLog(program));
        const uniforms = {};
        for (let i = 0; i < gl.getProgramParameter(program, gl.ACTIVE_UNIFORMS); ++i) {
            const { name, type } = gl.getActiveUniform(program, i);
            uniforms[name] = { at: gl.getUniformLocation(program, name), type };
        }
        return { program, uniforms };
    }

    // Values by name; of a texture its unit. What the program does not use is left out.
    use(name, values) {
        const gl = this.gl, { program, uniforms } = this.programs[name];
        gl.useProgram(program);
        for (const [key, value] of Object.entries(values)) {
            const uniform = uniforms[key];
            if (!uniform) continue;
            switch (uniform.type) {
                case gl.FLOAT: gl.uniform1f(uniform.at, value); break;
                case gl.FLOAT_VEC2: gl.uniform2fv(uniform.at, value); break;
                case gl.FLOAT_VEC3: gl.uniform3fv(uniform.at, value); break;
                case gl.FLOAT_MAT3: gl.uniformMatrix3fv(uniform.at, false, value); break;
                case gl.FLOAT_MAT4: gl.uniformMatrix4fv(uniform.at, false, value); break;
                default: gl.uniform1i(uniform.at, value);
            }
        }
    }

    buffer(data) {
        const gl = this.gl, buffer = gl.createBuffer();
        gl.bindBuffer(gl.ARRAY_BUFFER, buffer);
        if (data) gl.bufferData(gl.ARRAY_BUFFER, data, gl.STATIC_DRAW);
        return buffer;
    }

    particles() {
        const gl = this.gl, array = gl.createVertexArray(), buffer = this.buffer(null);
        gl.bindVertexArray(array);
        gl.bindBuffer(gl.ARRAY_BUFFER, this.square);
        gl.enableVertexAttribArray(0);
        gl.vertexAttribPointer(0, 2, gl.FLOAT, false, 0, 0);
        gl.bindBuffer(gl.ARRAY_BUFFER, buffer);
        gl.enableVertexAttribArray(1);
        gl.vertexAttribPointer(1, 4, gl.UNSIGNED_SHORT, true, 0, 0);
        gl.vertexAttribDivisor(1, 1);
        gl.bindVertexArray(null);
        return { array, buffer, count: 0, low: [0, 0, 0], size: [0, 0, 0], grown: 1 };
    }

    texture(width, height, internal, format, type, filter) {
        const gl = this.gl, texture = gl.createTexture();
        gl.bindTexture(gl.TEXTURE_2D, texture);
        gl.texImage2D(gl.TEXTURE_2D, 0, internal, width, height, 0, format, type, null);
        for (const key of [gl.TEXTURE_MIN_FILTER, gl.TEXTURE_MAG_FILTER]) gl.texParameteri(gl.TEXTURE_2D, key, filter);
        for (const key of [gl.TEXTURE_WRAP_S, gl.TEXTURE_WRAP_T]) gl.texParameteri(gl.TEXTURE_2D, key, gl.CLAMP_TO_EDGE);
        return texture;
    }

    // What can be drawn into: colour (null: none) and depth.
    target2d(width, height, colour) {
        const gl = this.gl, target = { width, height, frame: gl.createFramebuffer() };
        gl.bindFramebuffer(gl.FRAMEBUFFER, target.frame);
        if (colour) {
            target.colour = this.texture(width, height, ...colour);
            gl.framebufferTexture2D(gl.FRAMEBUFFER, gl.COLOR_ATTACHMENT0, gl.TEXTURE_2D, target.colour, 0);
        } else gl.drawBuffers([gl.NONE]);
        target.depth = this.texture(width, height, gl.DEPTH_COMPONENT24, gl.DEPTH_COMPONENT, gl.UNSIGNED_INT, gl.NEAREST);
        gl.framebufferTexture2D(gl.FRAMEBUFFER, gl.DEPTH_ATTACHMENT, gl.TEXTURE_2D, target.depth, 0);
        return target;
    }

    resize() {
        const gl = this.gl, ratio = Math.min(window.devicePixelRatio || 1, 2);
        const width = Math.max(1, Math.round(this.canvas.clientWidth * ratio)), height = Math.max(1, Math.round(this.canvas.clientHeight * ratio));
        if (this.opaque && this.canvas.width === width && this.canvas.height === height) return;
        this.canvas.width = width; this.canvas.height = height;
        for (const old of [this.opaque, this.final, this.deep, this.other, this.thick, this.soft]) {
            if (!old) continue;
            gl.deleteFramebuffer(old.frame); gl.deleteTexture(old.colour); gl.deleteTexture(old.depth);
        }
        const bytes = [gl.RGBA8, gl.RGBA, gl.UNSIGNED_BYTE, gl.LINEAR];
        this.opaque = this.target2d(width, height, bytes);
        this.final = this.target2d(width, height, bytes);
        if (!this.canSmooth) return;
        this.deep = this.target2d(width, height, [gl.R32F, gl.RED, gl.FLOAT, gl.NEAREST]);
        this.other = this.target2d(width, height, [gl.R32F, gl.RED, gl.FLOAT, gl.NEAREST]);
        this.thick = this.target2d(width, height, [gl.R16F, gl.RED, gl.HALF_FLOAT, gl.LINEAR]);
        this.soft = this.target2d(width, height, [gl.R16F, gl.RED, gl.HALF_FLOAT, gl.LINEAR]);
    }

    // A message of particles (link.js).
    take(frame) {
        const set = frame.kind === "solid" ? this.solid : this.liquid, gl = this.gl, s = 1 / frame.spacing;
        gl.bindBuffer(gl.ARRAY_BUFFER, set.buffer);
        gl.bufferData(gl.ARRAY_BUFFER, frame.places, gl.DYNAMIC_DRAW);
        set.count = frame.shown;
        set.low = vec.scale(frame.low, s);
        set.size = vec.scale(vec.sub(frame.high, frame.low), s);
        set.grown = Math.cbrt(Math.max(1, frame.particles / Math.max(1, frame.shown)));
        this.spacing = frame.spacing;
        if (set === this.liquid && !this.isPlaced && set.count) { this.isPlaced = true; this.showWhole(); }
        this.isDue = true;
    }

    box() {
        const { low, size, count } = this.liquid;
        if (!count) return { middle: [0, 0, 0], radius: 20 };
        return { middle: vec.add(low, vec.scale(size, .5)), radius: Math.max(4, vec.length(size) / 2) };
    }

    showWhole() {
        const { middle, radius } = this.box();
        this.target = middle; this.distance = radius * 3.7; this.viewRadius = radius;
        this.setWalls(this.wallList || []);
        this.isDue = true;
    }

    setWalls(list) {
        this.wallList = list;
        for (const wall of this.walls) { this.gl.deleteBuffer(wall.buffer); this.gl.deleteVertexArray(wall.array); }
        this.walls = this.spacing ? list.flatMap(wall => wallShapes(wall, 1 / this.spacing, this.target, (this.viewRadius || 20))).map(shape => this.mesh(shape)) : [];
        this.isDue = true;
    }

    mesh(shape) {
        const gl = this.gl, array = gl.createVertexArray();
        gl.bindVertexArray(array);
        const buffer = this.buffer(new Float32Array(shape.vertices));
        const size = shape.isLines ? 3 : 6;
        gl.enableVertexAttribArray(0);
        gl.vertexAttribPointer(0, 3, gl.FLOAT, false, 4 * size, 0);
        if (!shape.isLines) { gl.enableVertexAttribArray(1); gl.vertexAttribPointer(1, 3, gl.FLOAT, false, 4 * size, 12); }
        gl.bindVertexArray(null);
        return { ...shape, array, buffer, count: shape.vertices.length / size };
    }

    camera() {
        const c = Math.cos(this.pitch), aside = this.canvas.clientWidth > 720 ? 300 / this.canvas.clientWidth : 0;
        const out = [c * Math.cos(this.yaw), c * Math.sin(this.yaw), Math.sin(this.pitch)];
        const eye = vec.add(this.target, vec.scale(out, this.distance)), tangent = Math.tan(.3), aspect = this.canvas.width / this.canvas.height;
        const view = matrix.lookAt(eye, this.target, [0, 0, 1]);
        const projection = matrix.perspective(tangent, aspect, this.distance / 50, this.distance * 20);
        projection[8] = aside;                  // the middle of what the panel leaves free
        return { view, projection, tangent: [tangent * aspect, tangent], aside };
    }

    // Of view positions, and of the world's.
    shadowView(view) {
        const { middle, radius } = this.box(), sun = vec.unit([.42, -.38, .9]), r = radius * 1.5;
        const light = matrix.lookAt(vec.add(middle, vec.scale(sun, 3 * r)), middle, [0, 1, 0]);
        const projection = matrix.orthographic(r, r, 5 * r);
        const m = view, rotation = [m[0], m[4], m[8], m[1], m[5], m[9], m[2], m[6], m[10]];
        const eye = [0, 1, 2].map(i => -(rotation[3 * i] * 0 + m[4 * i] * m[12] + m[4 * i + 1] * m[13] + m[4 * i + 2] * m[14]));
        const back = new Float32Array([rotation[0], rotation[1], rotation[2], 0, rotation[3], rotation[4], rotation[5], 0, rotation[6], rotation[7], rotation[8], 0, ...eye, 1]);
        const turn = v => [0, 1, 2].map(i => m[i] * v[0] + m[4 + i] * v[1] + m[8 + i] * v[2]);
        return { light, projection, matrix: matrix.multiply(matrix.multiply(projection, light), back), sun: turn(sun), up: turn([0, 0, 1]), toWorld: new Float32Array(rotation) };
    }

    into(target) {
        const gl = this.gl;
        gl.bindFramebuffer(gl.FRAMEBUFFER, target ? target.frame : null);
        gl.viewport(0, 0, target ? target.width : this.canvas.width, target ? target.height : this.canvas.height);
    }

    bind(unit, texture) {
        this.gl.activeTexture(this.gl.TEXTURE0 + unit);
        this.gl.bindTexture(this.gl.TEXTURE_2D, texture);
        return unit;
    }

    drawParticles(program, set, values, radius) {
        if (!set.count) return;
        const gl = this.gl;
        this.use(program, { ...values, low: set.low, size: set.size, radius: radius * set.grown });
        gl.bindVertexArray(set.array);
        gl.drawArraysInstanced(gl.TRIANGLE_STRIP, 0, 4, set.count);
    }

    drawScreen(program, values) {
        const gl = this.gl;
        this.use(program, values);
        gl.disable(gl.DEPTH_TEST);
        gl.bindVertexArray(this.liquid.array);
        gl.drawArrays(gl.TRIANGLE_STRIP, 0, 4);
        gl.enable(gl.DEPTH_TEST);
    }

    draw() {
        this.resize();
        const gl = this.gl, { view, projection, tangent, aside } = this.camera(), shadow = this.shadowView(view);
        const pixel = [1 / this.canvas.width, 1 / this.canvas.height], isWater = this.look === "water" && this.canSmooth;
        gl.enable(gl.DEPTH_TEST); gl.disable(gl.BLEND);

        this.into(this.shadow);
        gl.clear(gl.DEPTH_BUFFER_BIT);
        this.drawParticles("shadow", this.liquid, { view: shadow.light, projection: shadow.projection }, .62);

        this.into(this.opaque);
        gl.clear(gl.DEPTH_BUFFER_BIT);
        this.drawScreen("sky", {});
        const light = { view, projection, sun: shadow.sun, up: shadow.up, shadowMatrix: shadow.matrix, shadowMap: this.bind(0, this.shadow.depth), shadowDepth: isWater ? .62 : .8 };
        this.drawParticles("particle", this.solid, { ...light, kind: 2 }, .56);
        if (!isWater) this.drawParticles("particle", this.liquid, { ...light, kind: this.look === "speed" ? 1 : 0 }, .54);
        this.drawWalls(light);

        this.into(this.final);
        if (isWater) this.drawWater(view, projection, tangent, aside, shadow, pixel);
        else this.blit();
        this.into(null);
        this.drawScreen("finish", { source: this.bind(0, this.final.colour), pixel });
    }

    drawWalls(light) {
        const gl = this.gl, grid = this.gridLength() / (this.spacing || 1);
        gl.enable(gl.BLEND); gl.blendFunc(gl.SRC_ALPHA, gl.ONE_MINUS_SRC_ALPHA);
        for (const wall of this.walls) {
            if (wall.culls) { gl.enable(gl.CULL_FACE); gl.cullFace(gl.FRONT); }
            if (wall.isLines) this.use("line", light);
            else this.use("wall", { ...light, grid, ...wall.values });
            gl.bindVertexArray(wall.array);
            gl.drawArrays(wall.isLines ? gl.LINES : gl.TRIANGLES, 0, wall.count);
            gl.disable(gl.CULL_FACE);
        }
        gl.disable(gl.BLEND);
    }

    // m
    gridLength() { return roundLength((this.viewRadius || 20) * (this.spacing || 1) * .5); }

    blit() {
        const gl = this.gl;
        gl.bindFramebuffer(gl.READ_FRAMEBUFFER, this.opaque.frame);
        gl.blitFramebuffer(0, 0, this.canvas.width, this.canvas.height, 0, 0, this.canvas.width, this.canvas.height, gl.COLOR_BUFFER_BIT, gl.NEAREST);
    }

    drawWater(view, projection, tangent, aside, shadow, pixel) {
        const gl = this.gl;
        for (const [target, far] of [[this.deep, 1e5], [this.thick, 0]]) {
            this.into(target);
            gl.clearBufferfv(gl.COLOR, 0, [far, far, far, 1]);
            gl.clear(gl.DEPTH_BUFFER_BIT);
            if (target === this.thick) { gl.disable(gl.DEPTH_TEST); gl.enable(gl.BLEND); gl.blendFunc(gl.ONE, gl.ONE); }
            this.drawParticles(target === this.deep ? "depth" : "thickness", this.liquid, { view, projection }, target === this.deep ? .80 : .55);
        }
        gl.disable(gl.BLEND);
        const width = 1.15 * this.liquid.grown * this.canvas.height / (2 * tangent[1]);
        for (let i = 0; i < 6; ++i) {
            const [from, to] = i % 2 ? [this.other, this.deep] : [this.deep, this.other];
            this.into(to);
            this.drawScreen("blur", { source: this.bind(0, from.colour), pixel, direction: i % 2 ? [0, 1] : [1, 0], width: width * (i < 4 ? 1 : .5) });
        }
        for (const [from, to, direction] of [[this.thick, this.soft, [1, 0]], [this.soft, this.thick, [0, 1]]]) {
            this.into(to);
            this.drawScreen("soften", { source: this.bind(0, from.colour), pixel, direction, width: .6 * width / this.distance });
        }
        this.into(this.final);
        const size = Math.max(8, this.viewRadius || 20);
        this.drawScreen("water", {
            depths: this.bind(0, this.deep.colour), thicknesses: this.bind(1, this.thick.colour), background: this.bind(2, this.opaque.colour),
            backgroundDepth: this.bind(3, this.opaque.depth), pixel, tangent, aside, projection, sun: shadow.sun, up: shadow.up, toWorld: shadow.toWorld,
            absorption: vec.scale([.95, .34, .14], 1 / size),
        });
    }

    // Drag turns, the second button or shift moves, wheel and two fingers come nearer, a double click shows all.
    listen() {
        const pointers = new Map(), due = () => { this.isDue = true; };
        let apart = 0;
        this.canvas.addEventListener("pointerdown", e => { pointers.set(e.pointerId, e); this.canvas.setPointerCapture(e.pointerId); });
        for (const end of ["pointerup", "pointercancel"]) this.canvas.addEventListener(end, e => { pointers.delete(e.pointerId); apart = 0; });
        this.canvas.addEventListener("pointermove", e => {
            const last = pointers.get(e.pointerId);
            if (!last) return;
            const dx = e.clientX - last.clientX, dy = e.clientY - last.clientY;
            pointers.set(e.pointerId, e);
            if (pointers.size === 2) {
                const [a, b] = [...pointers.values()], now = Math.hypot(a.clientX - b.clientX, a.clientY - b.clientY);
                if (apart) this.distance *= apart / now;
                apart = now;
            } else if (e.buttons === 2 || e.shiftKey) {
                const step = 2 * this.distance * Math.tan(.3) / this.canvas.clientHeight, side = [-Math.sin(this.yaw), Math.cos(this.yaw), 0];
                this.target = vec.add(vec.add(this.target, vec.scale(side, -dx * step)), [0, 0, dy * step]);
            } else {
                this.yaw -= dx * .008;
                this.pitch = Math.max(-1.5, Math.min(1.5, this.pitch + dy * .008));
            }
            due();
        });
        this.canvas.addEventListener("wheel", e => { this.distance *= Math.exp(Math.sign(e.deltaY) * .1); due(); e.preventDefault(); }, { passive: false });
        this.canvas.addEventListener("contextmenu", e => e.preventDefault());
        this.canvas.addEventListener("dblclick", () => this.showWhole());
        window.addEventListener("resize", due);
    }
}

// Triangles (places and normals) or lines that show a wall; s: units a metre, about a point, within a reach.
function wallShapes(wall, s, about, radius) {
    const theta = wall.theta ?? -1, values = { theta, reach: 0, opacity: 1, across1: [1, 0, 0], across2: [0, 1, 0], middle: [0, 0, 0] };
    const at = p => vec.scale(p, s), quad = (o, u, v, n) => [[-1, -1], [1, -1], [1, 1], [-1, -1], [1, 1], [-1, 1]].flatMap(([a, b]) => [...vec.add(o, vec.add(vec.scale(u, a), vec.scale(v, b))), ...n]);
    if (wall.type === "plane") {
        const point = at(wall.point), n = wall.direction, [u, v] = across(n), reach = 9 * radius;
        const middle = vec.sub(about, vec.scale(n, vec.dot(vec.sub(about, point), n)));
        const down = vec.scale(n, .02);
        return [{ vertices: quad(vec.sub(middle, down), vec.scale(u, reach), vec.scale(v, reach), n), culls: false, values: { ...values, reach, middle, across1: u, across2: v } }];
    }
    if (wall.type === "box") {
        const a = at(wall.low), b = at(wall.high), corner = i => [0, 1, 2].map(k => i >> k & 1 ? b[k] : a[k]), lines = [];
        for (let i = 0; i < 8; ++i) for (let k = 0; k < 3; ++k) if (!(i >> k & 1)) lines.push(...corner(i), ...corner(i | 1 << k));
        const middle = [(a[0] + b[0]) / 2, (a[1] + b[1]) / 2, a[2]], half = [(b[0] - a[0]) / 2, (b[1] - a[1]) / 2];
        const floor = quad(middle, [half[0], 0, 0], [0, half[1], 0], [0, 0, 1]);
        return [{ vertices: floor, values: { ...values, reach: 1e6, middle } }, { vertices: lines, isLines: true }];
    }
    const isBall = wall.type === "sphere", r = wall.radius * s, centre = at(wall.point), vertices = [], n = isBall ? [0, 0, 1] : wall.direction, [u, v] = across(n);
    const along = isBall ? 0 : 5 * radius, start = isBall ? centre : vec.add(centre, vec.scale(n, vec.dot(vec.sub(about, centre), n)));
    const rows = isBall ? 48 : 1, columns = 96;
    const vertex = (i, j) => {
        const a = 2 * Math.PI * j / columns, h = isBall ? -Math.cos(Math.PI * i / rows) : 0, q = Math.sqrt(Math.max(0, 1 - h * h));
        const m = vec.add(vec.scale(n, h), vec.add(vec.scale(u, q * Math.cos(a)), vec.scale(v, q * Math.sin(a))));
        return [...vec.add(vec.add(start, vec.scale(m, r)), vec.scale(n, along * (2 * i / rows - 1))), ...m];
    };
    for (let i = 0; i < rows; ++i) for (let j = 0; j < columns; ++j) vertices.push(...vertex(i, j), ...vertex(i, j + 1), ...vertex(i + 1, j + 1), ...vertex(i, j), ...vertex(i + 1, j + 1), ...vertex(i + 1, j));
    return [{ vertices, culls: wall.inside, values: { ...values, opacity: wall.inside ? .45 : 1 } }];
}
