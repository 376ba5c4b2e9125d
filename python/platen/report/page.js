// Values under the pointer: the nearest drawn point of the labelled curves of a chart.
(function () {
  const shown = document.createElement("div");
  shown.id = "value";
  document.body.appendChild(shown);
  const read = (text) => (text.match(/[-+.\d][-+.\deE]*/g) || []).map(Number);
  const short = (v) => Number(v.toPrecision(4)).toString();
  for (const svg of document.querySelectorAll("svg.chart")) {
    const all = JSON.parse(svg.dataset.axes), points = {};
    svg.addEventListener("mouseleave", () => (shown.style.display = "none"));
    svg.addEventListener("mousemove", (event) => {
      const place = svg.createSVGPoint();
      place.x = event.clientX, place.y = event.clientY;
      const p = place.matrixTransform(svg.getScreenCTM().inverse());
      let best = { gap: 15 * 15 };
      for (const axes of all) {
        const [x0, y0, x1, y1] = axes.box;
        if (p.x < x0 || p.x > x1 || p.y < y0 || p.y > y1) continue;
        for (const [id, label] of axes.curves) {
          const path = document.getElementById(id)?.querySelector("path");
          points[id] ??= path ? read(path.getAttribute("d")) : [];
          for (let k = 0; k + 1 < points[id].length; k += 2) {
            const gap = (points[id][k] - p.x) ** 2 + (points[id][k + 1] - p.y) ** 2;
            if (gap < best.gap) best = { gap, label, axes, x: points[id][k], y: points[id][k + 1] };
          }
        }
      }
      shown.style.display = best.axes ? "block" : "none";
      if (!best.axes) return;
      const [x0, y0, x1, y1] = best.axes.box;
      const value = (share, [low, high], log) =>
        log ? 10 ** (Math.log10(low) + share * Math.log10(high / low)) : low + share * (high - low);
      const x = value((best.x - x0) / (x1 - x0), best.axes.x, best.axes.log[0]);
      const y = value((y1 - best.y) / (y1 - y0), best.axes.y, best.axes.log[1]);
      shown.textContent = `${best.label ? best.label + ": " : ""}${short(x)}${best.axes.units[0]}, ${short(y)}${best.axes.units[1]}`;
      shown.style.left = `${event.pageX + 12}px`, shown.style.top = `${event.pageY - 28}px`;
    });
  }
})();
