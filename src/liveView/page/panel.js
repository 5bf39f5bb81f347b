// SPDX-License-Identifier: GPL-3.0-or-later
// The page: what stands beside the scene, and how both follow the messages.

const element = id => document.getElementById(id);

class Panel {
    constructor() {
        this.scene = new Scene(element("scene"));
        this.charts = new Charts(element("charts"), element("more"));
        this.sliders = new Map();
        this.frames = 0; this.rate = 0;
        this.link = new Link(message => this.take(message));
        this.link.begin();
        for (const word of ["step", "write", "stop"]) element(word).onclick = () => this.link.send(word);
        element("pause").onclick = () => this.link.send(this.state === "paused" ? "run" : "pause");
        element("most").onchange = () => this.link.next(+element("most").value);
        element("whole").onclick = () => this.scene.showWhole();
        element("picture").onclick = () => this.savePicture();
        for (const button of element("look").children) button.onclick = () => this.choose(button.dataset.look);
        this.choose(this.scene.look);
        element("when").oninput = () => this.goTo(+element("when").value);
        element("play").onclick = () => { this.plays = !this.plays; element("play").textContent = this.plays ? "Pause" : "Play"; };
        setInterval(() => this.tick(), 1000);
        const loop = () => { this.frame(); requestAnimationFrame(loop); };
        requestAnimationFrame(loop);
    }

    take(message) {
        ({ scene: m => this.takeScene(m), state: m => this.takeState(m.state), notice: m => this.notify(m.text),
            history: m => this.charts.history(m.rows), solid: m => { this.scene.take(m); this.legend(); }, liquid: m => this.takeLiquid(m) })[message.kind]?.(message);
    }

    takeLiquid(frame) {
        this.scene.take(frame);
        if (frame.walls) this.scene.setWalls(frame.walls);
        this.last = frame;
        ++this.frames;
        element("time").textContent = withPrefix(frame.time, "s", 4);
        const values = Object.keys(frame.values).length ? frame.values : this.shape(frame);
        this.charts.add(frame.time, values);
        element("chartSection").hidden = false;
        this.detail();
        this.legend();
        this.isAnswered = true;
    }

    // Of a case that measures nothing.
    shape(frame) {
        const size = vec.sub(frame.high, frame.low);
        return { "liquid: height [m]": size[2] + frame.spacing, "liquid: width [m]": Math.max(size[0], size[1]) + frame.spacing, "liquid: maxSpeed [m/s]": frame.most };
    }

    detail() {
        const { step, particles, shown } = this.last, count = n => n.toLocaleString("en");
        const what = shown < particles ? `${count(shown)} of ${count(particles)} particles` : `${count(particles)} particles`;
        element("detail").textContent = `${this.isStored ? "" : `step ${count(step)} · `}${what}${this.isStored ? "" : ` · ${this.rate} frames/s`}`;
    }

    takeScene(scene) {
        this.caseScene = scene;
        element("case").textContent = scene.case;
        document.title = `${scene.case} – Shizuku`;
        this.scene.spacing = scene.spacing;
        this.scene.setWalls(scene.walls);
        this.isStored = scene.mode === "stored";
        element("runSection").hidden = this.isStored;
        element("fixed").hidden = this.isStored || scene.modifiable;
        element("caseSection").hidden = !(scene.sliders || []).length;
        for (const slider of scene.sliders || []) this.showSlider(slider, !scene.modifiable);
        if (this.isStored && scene.times.length) {
            element("times").hidden = false;
            element("when").max = scene.times.length - 1;
            if (this.index === undefined) this.goTo(0);
        }
        this.legend();
    }

    takeState(state) {
        if (state === "lost" && this.state === "ended") return;
        this.state = state;
        const words = { running: "running", paused: "paused", ended: "run has ended", lost: "not connected", stored: "stored case" };
        element("state").textContent = words[state];
        element("state").className = "pill " + state;
        element("pause").textContent = state === "paused" ? "Go on" : "Pause";
        const isOver = state === "ended" || state === "lost";
        for (const id of ["pause", "step", "write", "stop"]) element(id).disabled = isOver;
        for (const { input } of this.sliders.values()) if (isOver) input.disabled = true;
    }

    // Positions of a logarithmic slider are logarithms.
    showSlider(slider, isFixed) {
        const { name, label, unit, low, high, log } = slider;
        const position = x => log ? Math.log10(Math.max(x, low)) : x, value = x => log ? +(10 ** x).toPrecision(3) : x;
        let shown = this.sliders.get(name);
        if (!shown) {
            const root = document.createElement("div"), head = document.createElement("div"), input = document.createElement("input");
            const text = document.createElement("span"), output = document.createElement("output");
            root.className = "slider";
            input.type = "range"; input.dataset.name = name; input.setAttribute("aria-label", label);
            text.textContent = label;
            head.append(text, output); root.append(head, input);
            element("sliders").append(root);
            shown = { input, output };
            this.sliders.set(name, shown);
            input.oninput = () => {
                const x = value(+input.value);
                this.showValue(output, x, unit);
                shown.wanted = x; shown.held = performance.now();
            };
        }
        const { input, output } = shown;
        input.min = position(low); input.max = position(high);
        input.step = name.startsWith("theta") ? 1 : (position(high) - position(low)) / 400;
        input.disabled = isFixed;
        if (performance.now() - (shown.held || -1e9) < 1000) return;          // the hand is on it
        input.value = position(slider.value);
        this.showValue(output, slider.value, unit);
    }

    showValue(output, x, unit) {
        output.textContent = unit === "°" ? `${+x.toFixed(1)}°` : `${shortNumber(x)} ${unit}`;
    }

    // At most eight edits a second, of which the last counts.
    sendSliders() {
        for (const [name, shown] of this.sliders) {
            if (shown.wanted === undefined || performance.now() - (shown.sent || 0) < 125) continue;
            this.link.send(`set ${name} ${shown.wanted}`);
            shown.sent = performance.now();
            shown.wanted = undefined;
        }
    }

    choose(look) {
        this.scene.look = look; this.scene.isDue = true;
        for (const button of element("look").children) button.classList.toggle("on", button.dataset.look === look);
        this.legend();
    }

    legend() {
        const bar = (title, colours, low, high) => `<div>${title}<div class="bar" style="background:linear-gradient(90deg,${colours})"></div><div class="ends"><span>${low}</span><span>${high}</span></div></div>`;
        let html = "";
        if (this.scene.look === "speed" && this.last) html += bar("Speed", "#1a529e,#29a8c2,#fadb5c,#e6572b", "0", withPrefix(this.last.most, "m/s"));
        const walls = (this.caseScene?.walls || []).some(wall => wall.theta !== null) || this.scene.solid.count;
        if (walls) html += bar("Contact angle of walls", "#2173bd,#e0e6e8,#db6b29", "0°", "180°");
        if (this.scene.isPlaced) html += `<div>Grid ${withPrefix(this.scene.gridLength(), "m", 1)}</div>`;
        if (html !== this.html) element("legend").innerHTML = this.html = html;
    }

    notify(text) {
        element("notice").textContent = text;
        element("notice").classList.add("on");
        clearTimeout(this.hide);
        this.hide = setTimeout(() => element("notice").classList.remove("on"), 6000);
    }

    goTo(index) {
        this.index = index;
        element("when").value = index;
        element("whenText").textContent = withPrefix(this.caseScene.times[index], "s");
        this.link.send(`time ${index}`);
    }

    savePicture() {
        this.scene.draw();
        this.scene.canvas.toBlob(blob => {
            const link = document.createElement("a");
            link.href = URL.createObjectURL(blob);
            link.download = `${this.caseScene?.case || "shizuku"}-${(this.last?.time ?? 0).toPrecision(4)}s.png`;
            link.click();
            setTimeout(() => URL.revokeObjectURL(link.href), 1000);
        });
    }

    frame() {
        this.sendSliders();
        if (this.plays && performance.now() - (this.played || 0) > 80) {
            this.played = performance.now();
            this.goTo((this.index + 1) % this.caseScene.times.length);
        }
        if (this.scene.isDue) {
            this.scene.isDue = false;
            this.scene.draw();
        }
        if (this.isAnswered && !this.isStored) { this.isAnswered = false; this.link.next(+element("most").value); }
        if (performance.now() - (this.drawn || 0) > 200) { this.drawn = performance.now(); this.charts.draw(); }
    }

    tick() {
        this.rate = this.frames;
        this.frames = 0;
        if (this.last) this.detail();
    }
}

try { window.panel = new Panel(); }
catch (error) { element("notice").textContent = error.message; element("notice").classList.add("on"); }
