// The report of `abbe study`: everything is drawn from the JSON in #data.
(() => {
  'use strict';
  const data = JSON.parse(document.getElementById('data').textContent);
  const $ = id => document.getElementById(id);
  const make = (tag, attributes = {}, ...children) => {
    const node = document.createElement(tag);
    for (const [key, value] of Object.entries(attributes)) node.setAttribute(key, value);
    node.append(...children);
    return node;
  };
  const measured = data.settings.filter(s => s.cpu_s !== undefined);
  const families = data.families.filter(f => measured.some(s => s.family === f.name));
  const shapes = ['circle', 'rect', 'triangle', 'rectRot', 'crossRot', 'star', 'cross'];
  const shown = new Set(families.map(f => f.name));
  const index = name => families.findIndex(f => f.name === name);
  const css = name => getComputedStyle(document.documentElement).getPropertyValue(name).trim();
  const colour = name => css(`--c${Math.max(0, index(name)) % 14}`);
  const shape = name => shapes[Math.max(0, index(name)) % shapes.length];
  const scene = data.scene.split('/').pop();

  /// Three significant digits, no exponent where it can be helped.
  const digits = v => v === null || v === undefined ? '–'
    : v === 0 ? '0' : Math.abs(v) >= 1e9 ? `${Number((v / 1e9).toPrecision(3))} G` : Math.abs(v) >= 1e6 ? `${Number((v / 1e6).toPrecision(3))} M` : Math.abs(v) < 1e-4 ? v.toExponential(1)
    : Math.abs(v) >= 100 ? Math.round(v).toLocaleString('en').replace(/,/g, '\u2009') : String(Number(v.toPrecision(3)));
  const seconds = v => v === null || v === undefined ? '–' : `${v < 10 ? v.toFixed(2) : v.toFixed(1)} s`;

  const costs = {cpu_s: ['Processor seconds', s => s.cpu_s], wall_s: ['Seconds of the clock', s => s.wall_s],
    rays: ['Rays', s => s.rays.total], ratio: ['Times the render without dispersion', s => s.ratio_to_none]};
  const errors = {delta_e_mean: 'CIEDE2000, mean', delta_e_p99: 'CIEDE2000, 99 % below', relative_mse: 'Relative MSE of XYZ',
    flip: 'FLIP, mean', banding: 'Banding', noise: 'Noise', bias: 'Bias'};

  // ---- head
  const cheapest = measured.filter(s => s.delta_e_mean <= 1).sort((a, b) => a.cpu_s - b.cpu_s)[0];
  const best = [...measured].sort((a, b) => a.delta_e_mean - b.delta_e_mean)[0];
  $('title').textContent = `What accuracy costs in ${scene}`;
  document.title = `${scene}: what accuracy costs`;
  const times = s => s.ratio_to_none ? `, ${digits(s.ratio_to_none)} times the render without dispersion` : '';
  $('lead').textContent = cheapest
    ? `The cheapest setting with a mean CIEDE2000 below 1 is ${cheapest.name}: ${seconds(cheapest.cpu_s)} of processor time${times(cheapest)}, off by ${digits(cheapest.delta_e_mean)}.`
    : best ? `No setting comes below a mean CIEDE2000 of 1. The closest is ${best.name}: off by ${digits(best.delta_e_mean)} in ${seconds(best.cpu_s)}${times(best)}.` : 'Nothing was measured.';
  for (const [term, text] of [['Picture', `${data.width} × ${data.height}`], ['Reference', data.reference.text],
    ['Machine', `${data.machine.processor}, ${data.machine.threads} threads`],
    ['Made with', `abbe ${data.version}, ${data.machine.compiler.replace(/ \d{8}$/, '')}`], ['Load at the start', digits(data.machine.load)]])
    $('facts').append(make('div', {}, make('dt', {}, term), make('dd', {}, text)));
  $('command').textContent = data.command;
  $('made').textContent = `${measured.length} settings, ${measured.reduce((n, s) => n + s.runs.length, 0)} runs in ${digits(data.elapsed_s)} s of a budget of ${digits(data.budget_s)} s. Times are the least of a setting's runs, without reading the scene; errors are means over seeds. Plots: Chart.js (MIT).`;
  if (data.notes.length) data.notes.forEach(note => $('notes').append(make('li', {}, note)));
  else $('notes-section').remove();

  // ---- plots
  const charts = [];
  Chart.defaults.font.family = getComputedStyle(document.body).fontFamily;
  Chart.defaults.font.size = 12.5;
  Chart.defaults.animation = matchMedia('(prefers-reduced-motion: reduce)').matches ? false : {duration: 250};
  Chart.defaults.maintainAspectRatio = false;
  /// Ticks of a logarithmic axis: 1, 2, 5 of each decade; where it spans much, the decades.
  const nice = axis => {
    const decades = Math.log10(axis.max / axis.min);
    const keep = decades > 3 ? [1] : decades > 1.6 ? [1, 3] : [1, 2, 5];
    const ticks = [];
    for (let d = Math.floor(Math.log10(axis.min)); d <= Math.ceil(Math.log10(axis.max)); ++d)
      for (const m of keep) {
        const v = Number(`${m}e${d}`);
        if (v >= axis.min * 0.9999 && v <= axis.max * 1.0001) ticks.push({value: v});
      }
    if (ticks.length > 1) axis.ticks = ticks;
  };
  const axis = (title, log = true) => ({
    type: log ? 'logarithmic' : 'linear', title: {display: true, text: title, color: css('--soft')}, grid: {color: css('--grid')},
    border: {color: css('--line')}, ticks: {color: css('--soft'), maxRotation: 0, callback: v => digits(v)},
    ...(log ? {afterBuildTicks: nice} : {})});
  /// Some room around the points of a logarithmic axis.
  const room = (scale, values) => {
    const above = values.filter(v => v > 0);
    if (!above.length) return scale;
    scale.min = Math.min(...above) / 1.35;
    scale.max = Math.max(...above) * 1.35;
    return scale;
  };
  const tooltip = extra => ({backgroundColor: css('--ink'), titleColor: css('--paper'), bodyColor: css('--paper'), padding: 10,
    displayColors: false, cornerRadius: 6, ...extra});
  const lineOf = (family, points) => ({label: family.name, data: points, borderColor: colour(family.name), backgroundColor: colour(family.name),
    pointStyle: shape(family.name), radius: 5, hoverRadius: 8, borderWidth: 1.5, pointBorderWidth: 2, showLine: true, tension: 0});

  function frontOf(points) {
    const sorted = [...points].sort((a, b) => a.x - b.x || a.y - b.y);
    const front = [];
    for (const p of sorted) if (!front.length || p.y < front[front.length - 1].y) front.push(p);
    return front;
  }

  /// No logarithm of zero: such points lie on the lower edge, and say so when pointed at.
  function drawFront() {
    const cost = costs[$('cost').value], key = $('error').value;
    const usable = measured.filter(s => shown.has(s.family) && s[key] !== null && cost[1](s) > 0);
    const least = Math.min(...usable.map(s => s[key]).filter(v => v > 0), 1);
    const point = s => ({x: cost[1](s), y: s[key] > 0 ? s[key] : least / 2, setting: s});
    const all = usable.map(point);
    const sets = families.filter(f => shown.has(f.name)).flatMap(f => {
      const of = usable.filter(s => s.family === f.name);
      return [...new Set(of.map(s => s.aa))].map(aa => lineOf(f, of.filter(s => s.aa === aa).sort((a, b) => a.value - b.value).map(point)));
    });
    sets.push({label: 'front', data: frontOf(all), borderColor: css('--front'), borderWidth: 4, radius: 0, hitRadius: 0, hoverRadius: 0, showLine: true,
      tension: 0, order: 10, stepped: false});
    const labels = {id: 'labels', afterDatasetsDraw(chart) {
      const g = chart.ctx;
      g.save();
      g.font = `11.5px ${Chart.defaults.font.family}`;
      g.fillStyle = css('--soft');
      chart.data.datasets.forEach((set, d) => set.label !== 'front' && chart.getDatasetMeta(d).data.forEach((dot, i) =>
        g.fillText(digits(set.data[i].setting.value), dot.x + 8, dot.y - 6)));
      g.restore();
    }};
    const told = s => [`${cost[0]}: ${digits(cost[1](s))}`, `${errors[key]}: ${digits(s[key])}`, `CPU ${seconds(s.cpu_s)}, clock ${seconds(s.wall_s)}${times(s)}`,
      `CIEDE2000 ${digits(s.delta_e_mean)} mean, ${digits(s.delta_e_p99)} at 99 %`, `FLIP ${digits(s.flip)}   banding ${digits(s.banding)}`,
      `noise ${digits(s.noise)}   bias ${digits(s.bias)}`, `${digits(s.rays.total)} rays, ${digits(s.peak_mib)} MiB`];
    const chart = new Chart($('front'), {type: 'scatter', data: {datasets: sets}, plugins: [labels], options: {
      interaction: {mode: 'nearest', intersect: true},
      scales: {x: room(axis(cost[0]), all.map(p => p.x)), y: room(axis(`${errors[key]} (less is better)`), all.map(p => p.y))},
      plugins: {legend: {display: false}, tooltip: tooltip({filter: item => item.dataset.label !== 'front',
        callbacks: {title: items => items.length ? items[0].raw.setting.name : '', label: item => told(item.raw.setting)}})},
      onHover: (_, active, c) => { c.canvas.style.cursor = active.length ? 'pointer' : 'default'; },
      onClick: (_, active, c) => { const hit = active.find(a => c.data.datasets[a.datasetIndex].label !== 'front');
        if (hit) choose(c.data.datasets[hit.datasetIndex].data[hit.index].setting.name); }}});
    const order = sets.slice(0, -1).flatMap((set, d) => set.data.map((p, i) => ({datasetIndex: d, index: i, x: p.x, setting: p.setting})))
      .sort((a, b) => a.x - b.x);
    let at = -1;
    $('front').onkeydown = event => {
      const step = {ArrowRight: 1, ArrowDown: 1, ArrowLeft: -1, ArrowUp: -1}[event.key];
      if (event.key === 'Enter' && at >= 0) choose(order[at].setting.name);
      if (!step || !order.length) return;
      event.preventDefault();
      at = (at + step + order.length) % order.length;
      const dot = chart.getDatasetMeta(order[at].datasetIndex).data[order[at].index];
      chart.setActiveElements([order[at]]);
      chart.tooltip.setActiveElements([order[at]], {x: dot.x, y: dot.y});
      chart.update();
      $('front-text').textContent = `${order[at].setting.name}: ${told(order[at].setting).slice(0, 2).join(', ')}`;
    };
    return chart;
  }

  function drawGrowth() {
    const own = families.filter(f => f.parameter === 'bands' && shown.has(f.name));
    const aa = measured.length ? measured[0].aa : 'off';
    const sets = own.map(f => lineOf(f, measured.filter(s => s.family === f.name && s.aa === aa).sort((a, b) => a.value - b.value)
      .map(s => ({x: s.value, y: s.cpu_s, name: s.name}))));
    const points = sets.flatMap(s => s.data);
    return new Chart($('growth'), {type: 'scatter', data: {datasets: sets}, options: {
      scales: {x: room({...axis('Bands'), afterBuildTicks: s => { s.ticks = [...new Set(points.map(p => p.x))].map(value => ({value})); }}, points.map(p => p.x)), y: room(axis('Processor seconds'), points.map(p => p.y))},
      plugins: {legend: {display: false}, tooltip: tooltip({callbacks: {title: items => items[0].raw.name, label: item => seconds(item.raw.y)}})}}});
  }

  function drawDepth() {
    const own = families.filter(f => shown.has(f.name) && data.depth.some(p => p.family === f.name));
    const sets = own.map(f => lineOf(f, data.depth.filter(p => p.family === f.name).map(p => ({x: p.depth, y: p.delta_e, name: f.name}))));
    const points = sets.flatMap(s => s.data);
    const y = {...axis('CIEDE2000, mean', false), beginAtZero: true};
    return new Chart($('depth'), {type: 'scatter', data: {datasets: sets}, options: {
      scales: {x: {...axis('Surfaces on a path', false), ticks: {...axis('', false).ticks, stepSize: 2}}, y},
      plugins: {legend: {display: false}, tooltip: tooltip({callbacks: {title: items => items[0].raw.name,
        label: item => `${digits(item.raw.y)} at depth ${item.raw.x}`}})}}, plugins: [{id: 'empty', afterDraw(chart) {
          if (points.length) return;
          chart.ctx.fillStyle = css('--soft');
          chart.ctx.textAlign = 'center';
          chart.ctx.fillText('Not measured (see the notes)', chart.width / 2, chart.height / 2);
        }}]});
  }

  function draw() {
    charts.splice(0).forEach(chart => chart.destroy());
    charts.push(drawFront(), drawGrowth(), drawDepth());
  }

  function legend() {
    $('legend').replaceChildren(...families.map(f => {
      const paths = {circle: '<circle cx="7" cy="7" r="5"/>', rect: '<rect x="2.5" y="2.5" width="9" height="9"/>',
        triangle: '<path d="M7 1.5 12.8 12H1.2z"/>', rectRot: '<path d="M7 1 13 7 7 13 1 7z"/>'};
      const icon = `<svg viewBox="0 0 14 14" aria-hidden="true" fill="${colour(f.name)}" stroke="${colour(f.name)}" stroke-width="2">${paths[shape(f.name)] || '<path d="M2 2 12 12M12 2 2 12"/>'}</svg>`;
      const button = make('button', {type: 'button', 'aria-pressed': String(shown.has(f.name)), title: f.label});
      button.innerHTML = icon;
      button.append(f.name);
      button.onclick = () => {
        shown.has(f.name) ? shown.delete(f.name) : shown.add(f.name);
        legend();
        draw();
      };
      return make('li', {}, button);
    }));
  }

  // ---- cost at equal error
  function equal() {
    const row = data.equal_error.find(r => String(r.delta_e) === $('target').value);
    const entries = families.map(f => [f, row && row.cpu_s[f.name]]).sort((a, b) => (a[1] ?? Infinity) - (b[1] ?? Infinity));
    const known = entries.map(e => e[1]).filter(v => v !== undefined);
    const most = Math.max(...known, 0), least = Math.min(...known);
    const swatch = f => make('span', {class: 'swatch', style: `background:${colour(f.name)}`});
    const body = entries.map(([f, cost]) => {
      const name = make('td', {}, swatch(f), f.name);
      if (cost === undefined) return make('tr', {}, name, make('td', {class: 'none'}, 'not reached'), make('td', {}, ''), make('td', {class: 'bar'}), make('td', {class: 'none', style: 'text-align:left'}, f.label));
      return make('tr', {}, name, make('td', {}, seconds(cost)), make('td', {}, `${digits(cost / least)} ×`),
        make('td', {class: 'bar'}, make('span', {style: `width:${100 * cost / most}%;background:${colour(f.name)}`})), make('td', {style: 'text-align:left'}, f.label));
    });
    const heads = ['Mode', 'CPU', 'Of the best', '', ''].map(text => make('th', {scope: 'col'}, text));
    heads[4].textContent = 'What it is';
    heads[4].style.textAlign = 'left';
    $('equal').replaceChildren(make('thead', {}, make('tr', {}, ...heads)), make('tbody', {}, ...body));
  }

  // ---- pictures
  const pictures = data.pictures;
  const source = name => name === 'reference' ? pictures.reference : pictures.settings[name] && pictures.settings[name].picture;
  const images = new Map();
  const image = name => {
    if (!images.has(name)) images.set(name, new Promise(resolve => {
      const img = new Image();
      img.onload = () => resolve(img);
      img.src = source(name);
    }));
    return images.get(name);
  };
  const zoom = 3;
  const crop = {w: Math.max(8, Math.round(data.width / zoom)), h: Math.max(6, Math.round(data.height / zoom)), x: 0, y: 0};

  async function paint(canvas, name) {
    const img = await image(name);
    canvas.width = crop.w;
    canvas.height = crop.h;
    canvas.getContext('2d').drawImage(img, crop.x, crop.y, crop.w, crop.h, 0, 0, crop.w, crop.h);
  }

  async function show() {
    const left = $('left').value, right = $('right').value;
    $('tag-left').textContent = left;
    $('tag-right').textContent = right;
    await Promise.all([paint($('crop-left'), left), paint($('crop-right'), right)]);
    const frame = $('overview').querySelector('i');
    Object.assign(frame.style, {left: `${100 * crop.x / data.width}%`, top: `${100 * crop.y / data.height}%`,
      width: `${100 * crop.w / data.width}%`, height: `${100 * crop.h / data.height}%`});
    const of = right === 'reference' ? left : right, entry = pictures.settings[of];
    for (const [id, key, text] of [['error-map', 'error', `Error of ${of}`], ['cost-map', 'cost', `Rays of ${of}`]]) {
      const there = entry && entry[key];
      $(id).closest('figure').hidden = !there;
      if (!there) continue;
      $(id).src = entry[key];
      $(id).alt = `${text}, per pixel`;
      $(`${key}-caption`).textContent = text;
    }
  }

  function move(x, y) {
    crop.x = Math.round(Math.min(Math.max(0, x - crop.w / 2), data.width - crop.w));
    crop.y = Math.round(Math.min(Math.max(0, y - crop.h / 2), data.height - crop.h));
    show();
  }

  /// Where the pictures differ most: the mean brightness of the error map, by blocks.
  async function worst(name) {
    const entry = pictures.settings[name];
    if (!entry) return [data.width / 2, data.height / 2];
    const img = new Image();
    await new Promise(resolve => { img.onload = resolve; img.src = entry.error; });
    const n = 12, canvas = make('canvas', {width: n, height: n}), g = canvas.getContext('2d');
    g.imageSmoothingQuality = 'high';
    g.drawImage(img, 0, 0, n, n);
    const px = g.getImageData(0, 0, n, n).data;
    let top = [-1, 0, 0];
    for (let y = 2; y < n - 2; ++y) for (let x = 2; x < n - 2; ++x) {
      let sum = 0;
      for (let v = -2; v < 2; ++v) for (let u = -2; u < 2; ++u) { const at = 4 * ((y + v) * n + x + u); sum += px[at] + px[at + 1] + px[at + 2]; }
      if (sum > top[0]) top = [sum, x, y];
    }
    return [top[1] / n * data.width, top[2] / n * data.height];
  }

  function choose(name) {
    $('right').value = name;
    show();
    $('h-pictures').scrollIntoView({behavior: 'smooth', block: 'start'});
  }

  function scaleBar(id, scale, labels) {
    $(id).replaceChildren(labels[0], make('b', {style: `background:linear-gradient(90deg,${scale.colours.join(',')})`}), labels[1]);
  }

  // ---- all figures
  const columns = [['Setting', s => s.name, null], ['CPU', s => s.cpu_s, seconds], ['× none', s => s.ratio_to_none, digits], ['Clock', s => s.wall_s, seconds],
    ['ΔE mean', s => s.delta_e_mean, digits], ['ΔE 99 %', s => s.delta_e_p99, digits], ['rel. MSE', s => s.relative_mse, digits], ['FLIP', s => s.flip, digits],
    ['Banding', s => s.banding, digits], ['Noise', s => s.noise, digits], ['Bias', s => s.bias, digits], ['Rays', s => s.rays.total, digits],
    ['Monochrom.', s => s.rays.monochromatic, digits], ['Shadow', s => s.rays.shadow, digits], ['MiB', s => s.peak_mib, digits], ['Runs', s => s.runs.length, digits]];
  let sorted = [1, 1];
  function table() {
    const [column, direction] = sorted, value = columns[column][1];
    const rows = [...measured].sort((a, b) => {
      const [x, y] = [value(a), value(b)];
      return direction * (typeof x === 'string' ? x.localeCompare(y, 'en', {numeric: true}) : (x ?? Infinity) - (y ?? Infinity));
    });
    const head = columns.map(([name], i) => {
      const button = make('button', {type: 'button'}, name);
      button.onclick = () => { sorted = [i, i === sorted[0] ? -sorted[1] : 1]; table(); $('all').querySelectorAll('thead button')[i].focus(); };
      const th = make('th', {scope: 'col'}, button);
      if (i === column) th.setAttribute('aria-sort', direction > 0 ? 'ascending' : 'descending');
      return th;
    });
    const body = rows.map(s => make('tr', {}, ...columns.map(([, get, format], i) => i === 0
      ? make('td', {}, make('span', {class: 'swatch', style: `background:${colour(s.family)}`}), s.name, ...(s.on_front ? [make('span', {class: 'front-mark'}, 'front')] : []))
      : make('td', {}, format(get(s))))));
    $('all').replaceChildren(make('thead', {}, make('tr', {}, ...head)), make('tbody', {}, ...body));
  }

  // ---- start
  const options = (id, entries, value) => {
    $(id).replaceChildren(...entries.map(([v, text]) => make('option', {value: v}, text)));
    if (value !== undefined) $(id).value = value;
  };
  options('cost', Object.entries(costs).filter(([, [, get]]) => measured.some(s => get(s) > 0)).map(([k, [text]]) => [k, text]));
  options('error', Object.entries(errors).filter(([k]) => measured.some(s => s[k] > 0)));
  $('cost').onchange = $('error').onchange = draw;
  const reached = row => Object.keys(row.cpu_s).length;
  const target = data.equal_error.filter(r => reached(r) >= families.length / 2).pop() || data.equal_error[0];
  options('target', data.equal_error.map(r => [String(r.delta_e), String(r.delta_e)]), target && String(target.delta_e));
  $('target').onchange = equal;
  const names = ['reference', ...measured.map(s => s.name)].filter(source).map(name => [name, name]);
  const coarse = measured.find(s => s.family !== 'none' && s.value === 8) || measured[0];
  options('left', names, 'reference');
  options('right', names, coarse && coarse.name);
  $('left').onchange = $('right').onchange = show;
  $('divider').oninput = () => $('wipe').style.setProperty('--at', `${$('divider').value}%`);
  $('wipe').style.aspectRatio = `${crop.w} / ${crop.h}`;
  $('overview').append(make('img', {src: pictures.reference, alt: 'The reference; click to choose the part that is enlarged'}), make('i'));
  $('overview').onclick = event => {
    const box = $('overview').getBoundingClientRect();
    move((event.clientX - box.left) / box.width * data.width, (event.clientY - box.top) / box.height * data.height);
  };
  scaleBar('error-scale', pictures.scales.error, ['0', `ΔE ${pictures.scales.error.most}`]);
  scaleBar('cost-scale', pictures.scales.cost, ['1', digits(pictures.scales.cost.most)]);
  const repaint = () => { legend(); draw(); equal(); table(); };
  repaint();
  matchMedia('(prefers-color-scheme: dark)').addEventListener('change', repaint);
  if (coarse) worst(coarse.name).then(([x, y]) => move(x, y));
})();
