// SPDX-License-Identifier: GPL-3.0-or-later
// Measured values over time, a small chart each.

class Charts {
    constructor(root, more) {
        this.root = root; this.more = more;
        this.rows = new Map();          // name: [[time, value], ...]
        this.charts = new Map();
        this.showsAll = false;
        more.onclick = () => { this.showsAll = true; more.hidden = true; this.isDue = true; };
    }

    // What an engineer looks for first comes first.
    static rank(name) {
        const at = [/^angle/i, /diameter|radius|width/i, /height/i, /volume/i, /energy/i, /speed/i].findIndex(word => word.test(name.split(": ").pop()));
        return at < 0 ? 9 : at;
    }

    add(time, values) {
        for (const [name, value] of Object.entries(values)) {
            if (!Number.isFinite(value)) continue;
            if (!this.rows.has(name)) this.rows.set(name, []);
            const rows = this.rows.get(name);
            if (rows.length && time <= rows[rows.length - 1][0]) {
                if (time < rows[rows.length - 1][0]) rows.length = 0;
                else continue;
            }
            rows.push([time, value]);
            if (rows.length > 3000) this.rows.set(name, rows.filter((row, i) => i % 2 === 0));
        }
        this.isDue = true;
    }

    // What was measured before this page was opened.
    history(rows) {
        const later = this.rows;
        this.rows = new Map();
        for (const [time, values] of rows) this.add(time, values);
        for (const [name, list] of later) for (const [time, value] of list) this.add(time, { [name]: value });
    }

    names() {
        const all = [...this.rows.keys()].sort((a, b) => Charts.rank(a) - Charts.rank(b));
        if (this.showsAll) return all;
        const first = [], seen = new Set();
        for (const name of all) {
            const rank = Charts.rank(name);
            if (rank < 9 && !seen.has(rank) && first.length < 5) { seen.add(rank); first.push(name); }
        }
        this.more.hidden = first.length === all.length;
        return first.length ? first : all.slice(0, 4);
    }

    draw() {
        if (!this.isDue) return;
        this.isDue = false;
        for (const name of this.names()) {
            if (!this.charts.has(name)) this.charts.set(name, this.make(name));
            this.line(this.charts.get(name), this.rows.get(name));
        }
    }

    make(name) {
        const chart = document.createElement("div");
        chart.className = "chart";
        const [title, unit] = name.includes(" [") ? name.slice(0, -1).split(" [") : [name, ""];
        const head = document.createElement("div"), label = document.createElement("span"), output = document.createElement("output"), canvas = document.createElement("canvas");
        const [owner, quantity] = title.split(": ");
        label.textContent = quantity ? `${quantity.replace(/([a-z])([A-Z])/g, "$1 $2").toLowerCase()} (${owner})` : title;
        head.append(label, output);
        chart.append(head, canvas);
        this.root.append(chart);
        return { canvas, output, unit };
    }

    line({ canvas, output, unit }, rows) {
        const ratio = window.devicePixelRatio || 1, width = canvas.clientWidth, height = canvas.clientHeight, g = canvas.getContext("2d");
        if (canvas.width !== width * ratio) { canvas.width = width * ratio; canvas.height = height * ratio; }
        g.setTransform(ratio, 0, 0, ratio, 0, 0);
        g.clearRect(0, 0, width, height);
        const last = rows[rows.length - 1][1], known = unit === "deg" ? "°" : unit.replace(/([a-z])([23])/g, (all, letter, power) => letter + (power === "2" ? "²" : "³"));
        output.textContent = `${shortNumber(last)} ${known}`;
        let low = Infinity, high = -Infinity;
        for (const [, value] of rows) { low = Math.min(low, value); high = Math.max(high, value); }
        if (high - low <= 1e-6 * Math.abs(high)) { const pad = Math.abs(high) * .05 || 1; low -= pad; high += pad; }
        const begin = rows[0][0], end = Math.max(rows[rows.length - 1][0], begin + 1e-30), right = width - 48;
        const x = t => right * (t - begin) / (end - begin), y = v => 6 + (height - 12) * (high - v) / (high - low);
        g.strokeStyle = "#d5dee5"; g.lineWidth = 1;
        g.beginPath();
        for (const level of [low, high]) { g.moveTo(0, y(level)); g.lineTo(right, y(level)); }
        g.stroke();
        g.fillStyle = "#5b6f7e"; g.font = "10px system-ui, 'DejaVu Sans', sans-serif"; g.textBaseline = "middle";
        for (const level of [low, high]) g.fillText(shortNumber(level), right + 5, y(level));
        g.strokeStyle = "#1673b8"; g.lineWidth = 1.6; g.lineJoin = "round";
        g.beginPath();
        rows.forEach(([t, v], i) => i ? g.lineTo(x(t), y(v)) : g.moveTo(x(t), y(v)));
        g.stroke();
        g.fillStyle = "#1673b8";
        g.beginPath(); g.arc(x(end), y(last), 2.6, 0, 7); g.fill();
    }
}
