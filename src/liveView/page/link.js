// SPDX-License-Identifier: GPL-3.0-or-later
// Where frames come from: a program's WebSocket, or what an exported page holds.

// A binary message (ViewFrame.H): the numbers of its text, and `places`, four words a particle.
function decodeFrame(bytes) {
    const length = new DataView(bytes).getUint32(0, true);
    const frame = JSON.parse(new TextDecoder().decode(new Uint8Array(bytes, 4, length)));
    frame.places = new Uint16Array(bytes, 4 + length, 4 * frame.shown);
    return frame;
}

class Link {
    // take(message): of kind scene, state, notice, history, solid or liquid.
    constructor(take) {
        this.take = take;
        if (window.shizukuExport) this.stored = window.shizukuExport;
        else this.open();
    }

    begin() {
        if (!this.stored) return;
        this.take(this.stored.scene);
        if (this.stored.solid) this.take(this.unpacked(this.stored.solid));
        this.take({ kind: "state", state: "stored" });
    }

    open() {
        const socket = this.socket = new WebSocket(`ws://${location.host}/live${location.search}`);
        socket.binaryType = "arraybuffer";
        socket.onmessage = ({ data }) => this.take(typeof data === "string" ? JSON.parse(data) : decodeFrame(data));
        socket.onopen = () => { this.wasOpen = true; this.next(); };
        socket.onclose = () => this.take({ kind: "state", state: "lost" });
    }

    unpacked(text) {
        const bytes = atob(text), array = new Uint8Array(bytes.length);
        for (let i = 0; i < bytes.length; ++i) array[i] = bytes.charCodeAt(i);
        return decodeFrame(array.buffer);
    }

    // The next frame, of at most so many particles.
    next(limit = this.limit || 200000) {
        this.limit = limit;
        this.send(`next ${limit}`);
    }

    send(text) {
        if (this.stored) {
            const [word, index] = text.split(" ");
            if (word !== "time") return;
            if (this.stored.solids) this.take(this.unpacked(this.stored.solids[+index]));
            this.take(this.unpacked(this.stored.frames[+index]));
        } else if (this.socket.readyState === WebSocket.OPEN) this.socket.send(text);
    }
}
