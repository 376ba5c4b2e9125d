// The specimen of a report's page, turned by hand: spheres as shaded discs with their own depth, cracks as discs, platens
// as frames of boxes or cylinders, the sleeve as a veil, all in one WebGL 2 canvas. Data come with the page (view.py says in which layout).
(function () {
  'use strict';
  const root = document.getElementById('specimen-view');
  if (!root) return;
  const canvas = root.querySelector('canvas'), message = root.querySelector('.view-message');
  const started = performance.now();
  const tell = (text) => { message.textContent = text; };
  const gl = canvas.getContext('webgl2', {alpha: false, antialias: true, preserveDrawingBuffer: true});
  if (!gl) { tell('This browser shows no WebGL 2: the pictures below show the same.'); return; }

  // ---- data
  const meta = JSON.parse(document.getElementById('specimen-view-meta').textContent);
  const bytes = Uint8Array.from(atob(document.getElementById('specimen-view-data').textContent.trim()), (c) => c.charCodeAt(0));
  const N = meta.spheres, C = meta.cracks, F = meta.frames.length;
  let at = 0;
  const take = (Type, count) => {
    const part = bytes.slice(at, at + count * Type.BYTES_PER_ELEMENT);
    at += part.length;
    return new Type(part.buffer);
  };
  const radius = Float32Array.from(take(Uint16Array, N), (r) => r * meta.radius_step);
  const frames = meta.frames.map(() => ({place: take(Uint16Array, 3 * N), damage: take(Uint8Array, N), piece: take(Uint8Array, N)}));
  const crack = {place: take(Uint16Array, 3 * C), normal: take(Int8Array, 3 * C), mode: take(Uint8Array, C),
                 size: take(Uint16Array, C), frame: take(Uint8Array, C)};
  const sleeve_corners = meta.sleeve ? meta.sleeve.corners : 0;
  const sleeve_first = take(Uint16Array, 3 * sleeve_corners), sleeve_frames = meta.frames.map(() => take(Uint16Array, 3 * sleeve_corners));
  const metre = (frame, sphere, axis) => meta.origin[axis] + meta.step * frame.place[3 * sphere + axis];

  // ---- state of the view
  const words = ['damage', 'displacement', 'outward', 'piece'];
  const state = {frame: meta.start_frame, quantity: words[0], cut: 'y', depth: 0.5, tension: false, shear: false, sleeve: true, magnify: 1,
                 yaw: 0.6, pitch: 0.25, zoom: 1, pan: [0, 0], picked: -1, playing: false};
  const low = meta.low, high = meta.high; // corners of the specimen before the test, m
  const middle = [0, 1, 2].map((k) => (low[k] + high[k]) / 2);
  const reach = Math.hypot(high[0] - low[0], high[1] - low[1], high[2] - low[2]) / 2;

  // ---- programs
  const buffer = (data) => {
    const b = gl.createBuffer();
    refill(b, data);
    return b;
  };
  const refill = (b, data) => {
    gl.bindBuffer(gl.ARRAY_BUFFER, b);
    gl.bufferData(gl.ARRAY_BUFFER, data, gl.DYNAMIC_DRAW);
  };
  // attributes: [buffer, numbers, type, whether 1 is the largest, whether it is of an instance] by name. Gives use(more): what is drawn next
  // is drawn by it, with the uniforms of the view and `more`, numbers or arrays by name.
  const program_of = (vertex, fragment, attributes) => {
    const program = gl.createProgram(), array = gl.createVertexArray();
    for (const [type, text] of [[gl.VERTEX_SHADER, vertex], [gl.FRAGMENT_SHADER, fragment]]) {
      const shader = gl.createShader(type);
      gl.shaderSource(shader, '#version 300 es\nprecision highp float;\n' + text);
      gl.compileShader(shader);
      if (!gl.getShaderParameter(shader, gl.COMPILE_STATUS)) throw new Error(gl.getShaderInfoLog(shader));
      gl.attachShader(program, shader);
    }
    gl.linkProgram(program);
    if (!gl.getProgramParameter(program, gl.LINK_STATUS)) throw new Error(gl.getProgramInfoLog(program));
    gl.bindVertexArray(array);
    for (const [name, [b, size, type, normalized, instanced]] of Object.entries(attributes)) {
      const where = gl.getAttribLocation(program, name);
      gl.bindBuffer(gl.ARRAY_BUFFER, b);
      gl.enableVertexAttribArray(where);
      gl.vertexAttribPointer(where, size, type, Boolean(normalized), 0, 0);
      gl.vertexAttribDivisor(where, instanced ? 1 : 0);
    }
    return (more) => {
      gl.useProgram(program);
      gl.bindVertexArray(array);
      for (const [name, v] of Object.entries({...uniforms(), ...more})) {
        const where = gl.getUniformLocation(program, name);
        if (v.length === 9) gl.uniformMatrix3fv(where, true, v);
        else gl['uniform' + (v.length || 1) + 'fv'](where, [v].flat());
      }
    };
  };
  const common = `
uniform mat3 turn;        // specimen to view
uniform vec3 middle, cut; // m; cut: direction of what is taken away, 0: nothing
uniform vec2 pan, extent; // m: half width and height of what is seen
uniform float reach, depth, magnify, step_;
uniform vec3 origin;
vec4 seen(vec3 v) { return vec4((v.xy + pan) / extent, -v.z / (4.0 * reach), 1.0); }
`;
  const corners = buffer(new Float32Array([-1, -1, 1, -1, -1, 1, 1, 1]));
  const now_places = buffer(frames[0].place), colours = buffer(new Uint8Array(3 * N));
  const use_spheres = program_of(common + `
in vec2 corner; in vec3 place, first, colour; in float radius;
out vec2 at; out vec3 tint; out vec2 spread;
void main() {
  vec3 p = origin + step_ * (first + magnify * (place - first));
  vec3 v = turn * (p - middle);
  bool hidden = dot(cut, origin + step_ * first - middle) > depth;
  at = corner; tint = colour; spread = vec2(-v.z, radius) / (4.0 * reach);
  gl_Position = hidden ? vec4(2.0, 2.0, 2.0, 1.0) : seen(v + vec3(corner * radius, 0.0));
}`, `
in vec2 at; in vec3 tint; in vec2 spread; out vec4 colour;
void main() {
  float inside = 1.0 - dot(at, at);
  if (inside < 0.0) discard;
  float z = sqrt(inside);
  gl_FragDepth = 0.5 + 0.5 * (spread.x - spread.y * z);
  float light = max(0.0, dot(vec3(at, z), normalize(vec3(-0.4, 0.5, 0.8))));
  colour = vec4(tint * (0.4 + 0.6 * light) + 0.06 * light, 1.0);
}`, {corner: [corners, 2, gl.FLOAT], place: [now_places, 3, gl.UNSIGNED_SHORT, false, true],
     first: [buffer(frames[0].place), 3, gl.UNSIGNED_SHORT, false, true], colour: [colours, 3, gl.UNSIGNED_BYTE, true, true],
     radius: [buffer(radius), 1, gl.FLOAT, false, true]});
  const use_discs = program_of(common + `
in vec2 corner; in vec3 place, normal; in float size, mode, since; uniform vec2 shown; uniform float now;
out vec2 at; out vec3 tint;
void main() {
  vec3 p = origin + step_ * place, n = normalize(normal + vec3(0.0, 0.0, 1e-6));
  vec3 a = normalize(cross(n, abs(n.z) < 0.9 ? vec3(0, 0, 1) : vec3(1, 0, 0))), b = cross(n, a);
  bool hidden = dot(cut, p - middle) > depth || since > now || (mode < 0.5 ? shown.x : shown.y) < 0.5;
  at = corner; tint = mode < 0.5 ? vec3(0.84, 0.37, 0.0) : vec3(0.0, 0.45, 0.70);
  vec3 v = turn * (p + size * (corner.x * a + corner.y * b) - middle);
  gl_Position = hidden ? vec4(2.0, 2.0, 2.0, 1.0) : seen(v);
}`, `
in vec2 at; in vec3 tint; out vec4 colour;
void main() { if (dot(at, at) > 1.0) discard; colour = vec4(tint, 1.0); }`,
    {corner: [corners, 2, gl.FLOAT], place: [buffer(crack.place), 3, gl.UNSIGNED_SHORT, false, true],
     normal: [buffer(crack.normal), 3, gl.BYTE, true, true], mode: [buffer(crack.mode), 1, gl.UNSIGNED_BYTE, false, true],
     size: [buffer(Float32Array.from(crack.size, (s) => s * meta.radius_step)), 1, gl.FLOAT, false, true],
     since: [buffer(crack.frame), 1, gl.UNSIGNED_BYTE, false, true]});
  const veil_places = buffer(sleeve_frames[0]);
  const use_veil = program_of(common + `
in vec3 place, first;
out vec3 was, now;
void main() {
  was = origin + step_ * first - middle;
  now = turn * (was + magnify * step_ * (place - first));
  gl_Position = seen(now);
}`, `
in vec3 was, now; uniform vec3 cut, ink; uniform float depth, veil; out vec4 colour;
void main() {
  if (dot(cut, was) > depth) discard;
  float facing = abs(normalize(cross(dFdx(now), dFdy(now))).z);
  colour = vec4(ink, veil * (1.5 - facing));
}`, {place: [veil_places, 3, gl.UNSIGNED_SHORT], first: [buffer(sleeve_first), 3, gl.UNSIGNED_SHORT]});
  // Triangles of each face of the sleeve, and the edges around it: two of each face, the others are those of its neighbours.
  const sleeve_faces = meta.sleeve ? meta.sleeve.faces : [], triangles = [], edges_of_sleeve = [];
  for (let k = 0; k < sleeve_faces.length; k += 4) {
    const [a, b, c, d] = sleeve_faces.slice(k, k + 4);
    triangles.push(a, b, c, a, c, d);
    edges_of_sleeve.push(a, b, b, c);
  }
  gl.bindBuffer(gl.ELEMENT_ARRAY_BUFFER, gl.createBuffer());
  gl.bufferData(gl.ELEMENT_ARRAY_BUFFER, Uint32Array.from(triangles.concat(edges_of_sleeve)), gl.STATIC_DRAW);
  const line_places = buffer(new Float32Array(3));
  const use_lines = program_of(common + 'in vec3 place; void main() { gl_Position = seen(turn * (place - middle)); }',
    'uniform vec3 ink; out vec4 colour; void main() { colour = vec4(ink, 1.0); }', {place: [line_places, 3, gl.FLOAT]});

  // ---- colours
  const viridis = [[0.27, 0.0, 0.33], [0.23, 0.32, 0.55], [0.13, 0.57, 0.55], [0.37, 0.79, 0.38], [0.99, 0.91, 0.14]];
  const ramps = {damage: [[0.78, 0.78, 0.78], [0.95, 0.75, 0.45], [0.84, 0.37, 0.0], [0.45, 0.05, 0.05]], displacement: viridis,
                 outward: viridis};
  const palette = [[0.0, 0.62, 0.45], [0.80, 0.47, 0.65], [0.34, 0.71, 0.91], [0.94, 0.89, 0.26], [0.84, 0.37, 0.0], [0.55, 0.34, 0.29],
                   [0.15, 0.15, 0.15], [0.90, 0.62, 0.0], [0.0, 0.45, 0.70], [0.45, 0.65, 0.12]];
  const loose = [0.88, 0.88, 0.88];
  const ramp = (stops, share) => {
    const x = Math.min(Math.max(share, 0), 1) * (stops.length - 1), k = Math.min(Math.floor(x), stops.length - 2);
    return [0, 1, 2].map((c) => stops[k][c] + (x - k) * (stops[k + 1][c] - stops[k][c]));
  };
  // Of sphere s in frame f: damage 0 ... 1; displacement in m; outward from the axis (of a plane specimen: from x = 0) in m.
  const value = (quantity, f, s) => {
    const frame = frames[f], first = frames[0];
    if (quantity === 'damage') return frame.damage[s] / 255;
    if (quantity === 'piece') return frame.piece[s];
    const from = [0, 1, 2].map((k) => metre(first, s, k)), d = from.map((x, k) => metre(frame, s, k) - x);
    if (quantity === 'displacement') return Math.hypot(d[0], d[1], d[2]);
    if (meta.plane) return d[0] * Math.sign(from[0] - middle[0]);
    const x = from[0] - middle[0], y = from[1] - middle[1], r = Math.hypot(x, y);
    return r > 0 ? (d[0] * x + d[1] * y) / r : 0;
  };
  const tops = {damage: 1};
  const top_of = (quantity) => { // what 98 spheres in 100 do not exceed at the end
    if (!(quantity in tops)) {
      const all = Float64Array.from({length: N}, (_, s) => value(quantity, F - 1, s)).sort();
      tops[quantity] = Math.max(all[Math.floor(0.98 * (N - 1))], 0) || 1; // nothing has moved: any top
    }
    return tops[quantity];
  };
  const colour_of = (quantity, f, s) => {
    const v = value(quantity, f, s);
    if (quantity === 'piece') return v === 255 ? loose : v === 0 ? palette[0] : palette[1 + (v - 1) % (palette.length - 1)];
    return ramp(ramps[quantity], v / top_of(quantity));
  };
  const colour_all = () => {
    const data = new Uint8Array(3 * N);
    for (let s = 0; s < N; ++s) {
      const c = s === state.picked ? [1, 0, 1] : colour_of(state.quantity, state.frame, s);
      for (let k = 0; k < 3; ++k) data[3 * s + k] = Math.round(255 * c[k]);
    }
    refill(colours, data);
  };

  // ---- geometry of the view: x to the right, z up, y away
  const turned_by = (yaw, pitch) => {
    const cy = Math.cos(yaw), sy = Math.sin(yaw), cp = Math.cos(pitch), sp = Math.sin(pitch);
    return [[cy, sy, 0], [-sp * sy, sp * cy, cp], [sy * cp, -cy * cp, sp]]; // right, up, towards the eye
  };
  const turn = () => turned_by(state.yaw, state.pitch);
  const dot = (a, b) => a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
  const cut_direction = () => ({none: [0, 0, 0], x: [1, 0, 0], y: [0, -1, 0], z: [0, 0, 1]}[state.cut]);
  const cut_depth = () => { // m from the middle along the direction: 0 keeps nothing, 1 all
    const axis = {x: 0, y: 1, z: 2}[state.cut];
    return axis === undefined ? 0 : (2 * state.depth - 1) * (high[axis] - low[axis]) / 2;
  };
  const corners_of = (b) => [...Array(8).keys()].map((k) => [b[k & 1 ? 3 : 0], b[k & 2 ? 4 : 1], b[k & 4 ? 5 : 2]]);
  // Half width and height of what is seen, m: specimen and platens fit as they are seen at the beginning; platens that are much
  // larger do not count.
  const framed = [corners_of([...low, ...high]), meta.frames[0].platens.flatMap(corners_of)].map((places) => [0, 1].map((k) =>
    Math.max(0, ...places.map((p) => Math.abs(dot(turned_by(0.6, 0.25)[k], p.map((x, axis) => x - middle[axis])))))));
  const extent = () => {
    const wide = canvas.width / canvas.height, half = ([x, y]) => Math.max(y, x / wide);
    const height = 1.05 * Math.min(Math.max(half(framed[0]), half(framed[1])), 1.3 * half(framed[0])) / state.zoom;
    return [height * wide, height];
  };
  const uniforms = () => ({turn: turn().flat(), middle, origin: meta.origin, step_: meta.step, cut: cut_direction(), depth: cut_depth(),
                           pan: state.pan, extent: extent(), reach, magnify: state.magnify});
  const box_edges = (b) => {
    const p = corners_of(b), edges = [];
    if (b[6]) { // round about z: two circles, and four lines up
      const rim = (k, z) => [(b[0] + b[3] + (b[3] - b[0]) * Math.cos(k * Math.PI / 24)) / 2, (b[1] + b[4] + (b[4] - b[1]) * Math.sin(k * Math.PI / 24)) / 2, z];
      for (let k = 0; k < 48; ++k) for (const z of [b[2], b[5]]) edges.push(...rim(k, z), ...rim(k + 1, z));
      for (let k = 0; k < 48; k += 12) edges.push(...rim(k, b[2]), ...rim(k, b[5]));
      return edges;
    }
    for (let k = 0; k < 8; ++k) for (const bit of [1, 2, 4]) if (!(k & bit)) edges.push(...p[k], ...p[k | bit]);
    return edges;
  };

  let wanted = false;
  const draw = () => {
    wanted = false;
    const ratio = window.devicePixelRatio || 1, w = Math.round(canvas.clientWidth * ratio), h = Math.round(canvas.clientHeight * ratio);
    if (canvas.width !== w || canvas.height !== h) { canvas.width = w; canvas.height = h; }
    gl.viewport(0, 0, w, h);
    gl.clearColor(1, 1, 1, 1);
    gl.clear(gl.COLOR_BUFFER_BIT | gl.DEPTH_BUFFER_BIT);
    gl.enable(gl.DEPTH_TEST);
    use_spheres();
    gl.drawArraysInstanced(gl.TRIANGLE_STRIP, 0, 4, N);
    if (C > 0 && (state.tension || state.shear)) {
      use_discs({shown: [Number(state.tension), Number(state.shear)], now: state.frame});
      gl.drawArraysInstanced(gl.TRIANGLE_STRIP, 0, 4, C);
    }
    const edges = Float32Array.from(meta.frames[state.frame].platens.flatMap(box_edges));
    if (edges.length > 0) {
      use_lines({ink: [0.25, 0.25, 0.3]});
      refill(line_places, edges);
      gl.drawArrays(gl.LINES, 0, edges.length / 3);
    }
    if (!meta.sleeve || !state.sleeve) return;
    gl.enable(gl.BLEND); // the sleeve is over all else, which it lets through
    gl.blendFunc(gl.SRC_ALPHA, gl.ONE_MINUS_SRC_ALPHA);
    gl.depthMask(false);
    use_veil({ink: [0.55, 0.43, 0.4], veil: 0.35});
    gl.drawElements(gl.TRIANGLES, triangles.length, gl.UNSIGNED_INT, 0);
    use_veil({ink: [0.55, 0.43, 0.4], veil: 0.5});
    gl.drawElements(gl.LINES, edges_of_sleeve.length, gl.UNSIGNED_INT, 4 * triangles.length);
    gl.depthMask(true);
    gl.disable(gl.BLEND);
  };
  const redraw = () => { if (!wanted) { wanted = true; requestAnimationFrame(draw); } };

  // ---- words
  const control = (name) => root.querySelector('[data-view=' + name + ']');
  const units = {damage: '', displacement: ' mm', outward: ' mm', piece: ''};
  const said = (quantity, v) => (quantity === 'damage' ? v.toFixed(2)
    : quantity === 'piece' ? (v === 255 ? 'loose' : v === 0 ? 'largest' : String(v + 1)) : (1e3 * v).toPrecision(3)) + units[quantity];
  const legend = root.querySelector('.view-legend'), caption = root.querySelector('.view-caption');
  const names = {damage: 'broken fraction of bonds', displacement: 'displacement', outward: 'outward displacement', piece: 'fragment'};
  const describe = () => {
    const f = meta.frames[state.frame];
    caption.textContent = 'frame ' + (state.frame + 1) + ' of ' + F + ': ' + f.words;
    const so_far = (mode) => crack.frame.reduce((sum, since, c) => sum + (since <= state.frame && crack.mode[c] === mode), 0);
    control('tension-count').textContent = '(' + so_far(0) + ')';
    control('shear-count').textContent = '(' + so_far(1) + ')';
    const axis = 'xyz'.indexOf(state.cut), depth = axis < 0 ? 0 : middle[axis] + cut_direction()[axis] * cut_depth();
    control('depth-words').textContent = axis < 0 ? '' : state.cut + ' = ' + (1e3 * depth).toPrecision(3) + ' mm';
    control('depth').disabled = axis < 0;
    if (state.quantity === 'piece') legend.textContent = 'fragments that intact bonds hold together: green the largest, grey single spheres';
    else {
      const stops = ramps[state.quantity].map((c) => 'rgb(' + c.map((v) => Math.round(255 * v)).join(',') + ')').join(',');
      legend.innerHTML = '';
      const bar = document.createElement('span');
      bar.style.cssText = 'display:inline-block;width:10rem;height:0.8rem;margin:0 0.5rem;background:linear-gradient(to right,' + stops + ')';
      legend.append(names[state.quantity] + ': 0', bar, said(state.quantity, top_of(state.quantity)));
    }
    if (state.picked >= 0)
      tell('sphere ' + meta.ids[state.picked] + ': radius ' + (1e3 * radius[state.picked]).toPrecision(3) + ' mm, ' +
           words.map((q) => names[q] + ' ' + said(q, value(q, state.frame, state.picked))).join(', '));
  };
  const show_frame = () => {
    refill(now_places, frames[state.frame].place);
    refill(veil_places, sleeve_frames[state.frame]);
    refresh();
  };
  const refresh = () => { colour_all(); describe(); redraw(); };

  // ---- hands
  const view_of = (s) => { // of a sphere: x, y, z of the view in m; null where it is cut away
    const first = frames[0], frame = frames[state.frame], n = cut_direction(), m = turn();
    const from = [0, 1, 2].map((k) => metre(first, s, k) - middle[k]);
    if (n[0] * from[0] + n[1] * from[1] + n[2] * from[2] > cut_depth() && state.cut !== 'none') return null;
    const p = from.map((x, k) => x + state.magnify * (metre(frame, s, k) - metre(first, s, k)));
    return m.map((row) => row[0] * p[0] + row[1] * p[1] + row[2] * p[2]);
  };
  const pick = (event) => {
    const box = canvas.getBoundingClientRect(), e = extent();
    const x = ((event.clientX - box.left) / box.width * 2 - 1) * e[0] - state.pan[0];
    const y = (1 - (event.clientY - box.top) / box.height * 2) * e[1] - state.pan[1];
    let best = -1, nearest = -Infinity;
    for (let s = 0; s < N; ++s) {
      const v = view_of(s);
      if (!v) continue;
      const rest = radius[s] * radius[s] - (v[0] - x) ** 2 - (v[1] - y) ** 2;
      if (rest < 0) continue;
      const z = v[2] + Math.sqrt(rest);
      if (z > nearest) { nearest = z; best = s; }
    }
    state.picked = best;
    if (best < 0) tell('');
    refresh();
  };
  const pan_by = (dx, dy) => { // pixels
    const e = extent();
    state.pan[0] += 2 * e[0] * dx / canvas.clientWidth;
    state.pan[1] -= 2 * e[1] * dy / canvas.clientHeight;
  };
  let hand = null;
  const fingers = new Map();
  canvas.addEventListener('pointerdown', (event) => {
    canvas.setPointerCapture(event.pointerId);
    fingers.set(event.pointerId, event);
    hand = {x: event.clientX, y: event.clientY, moved: 0, pan: event.shiftKey || event.button !== 0};
  });
  canvas.addEventListener('pointermove', (event) => {
    if (!hand || !fingers.has(event.pointerId)) return;
    const before = fingers.get(event.pointerId);
    fingers.set(event.pointerId, event);
    const dx = event.clientX - before.clientX, dy = event.clientY - before.clientY;
    hand.moved += Math.abs(dx) + Math.abs(dy);
    if (fingers.size === 2) {
      const [a, b] = [...fingers.values()];
      const other = event.pointerId === a.pointerId ? b : a;
      const length = (p) => Math.hypot(p.clientX - other.clientX, p.clientY - other.clientY);
      zoom_by(length(event) / Math.max(1, length(before)));
      pan_by(dx / 2, dy / 2); // by the middle of both fingers
    } else if (hand.pan) {
      pan_by(dx, dy);
    } else {
      state.yaw -= dx * 0.008;
      tilt(dy * 0.008);
    }
    redraw();
  });
  const let_go = (event) => {
    fingers.delete(event.pointerId);
    if (hand && hand.moved < 4 && event.type === 'pointerup') pick(event);
    if (fingers.size === 0) hand = null;
  };
  canvas.addEventListener('pointerup', let_go);
  canvas.addEventListener('pointercancel', let_go);
  canvas.addEventListener('contextmenu', (event) => event.preventDefault());
  canvas.addEventListener('wheel', (event) => {
    event.preventDefault();
    zoom_by(Math.exp(-event.deltaY * 0.001));
    redraw();
  }, {passive: false});

  // ---- controls
  const bind = (name, event, act) => { const c = control(name); if (c) c.addEventListener(event, () => act(c)); return c; };
  const slider = bind('frame', 'input', (c) => { state.frame = Number(c.value); show_frame(); });
  slider.max = String(F - 1);
  slider.value = String(state.frame);
  const colour = bind('quantity', 'change', (c) => { state.quantity = c.value; refresh(); });
  for (const word of words) colour.add(new Option(names[word], word));
  bind('cut', 'change', (c) => { state.cut = c.value; describe(); redraw(); }).value = state.cut;
  bind('depth', 'input', (c) => { state.depth = Number(c.value); describe(); redraw(); });
  bind('magnify', 'input', (c) => { state.magnify = Number(c.value); c.nextElementSibling.textContent = '×' + c.value; redraw(); });
  bind('tension', 'change', (c) => { state.tension = c.checked; redraw(); });
  bind('shear', 'change', (c) => { state.shear = c.checked; redraw(); });
  bind('sleeve', 'change', (c) => { state.sleeve = c.checked; redraw(); });
  control('sleeve-label').hidden = !meta.sleeve;
  for (const name of ['tension-label', 'shear-label']) control(name).hidden = C === 0;
  const look_from_the_start = () => { Object.assign(state, {yaw: 0.6, pitch: 0.25, zoom: 1, pan: [0, 0]}); redraw(); };
  bind('reset', 'click', look_from_the_start);
  const go_to = (frame) => {
    state.frame = Math.min(F - 1, Math.max(0, frame));
    slider.value = String(state.frame);
    show_frame();
  };
  bind('play', 'click', (c) => {
    state.playing = !state.playing;
    c.textContent = state.playing ? 'stop' : 'play';
    const next = () => {
      if (!state.playing) return;
      go_to((state.frame + 1) % F);
      setTimeout(next, 200);
    };
    next();
  });
  const tilt = (by) => { state.pitch = Math.min(Math.PI / 2, Math.max(-Math.PI / 2, state.pitch + by)); };
  const zoom_by = (factor) => { state.zoom = Math.min(50, Math.max(0.2, state.zoom * factor)); };
  const keys = {
    ArrowLeft: () => { state.yaw += 0.1; }, ArrowRight: () => { state.yaw -= 0.1; }, ArrowUp: () => tilt(-0.1), ArrowDown: () => tilt(0.1),
    '+': () => zoom_by(1.15), '=': () => zoom_by(1.15), '-': () => zoom_by(1 / 1.15), Home: look_from_the_start,
    PageUp: () => go_to(state.frame - 1), PageDown: () => go_to(state.frame + 1)};
  canvas.addEventListener('keydown', (event) => {
    if (!(event.key in keys) || event.ctrlKey || event.altKey || event.metaKey) return;
    event.preventDefault();
    keys[event.key]();
    redraw();
  });
  window.addEventListener('resize', redraw);

  show_frame();
  draw();
  gl.finish();
  root.dataset.ready = (performance.now() - started).toFixed(0); // ms from the script's start to the first picture
  root.platen = {state, meta, value, refresh: show_frame, draw}; // for tests and for the console
})();
