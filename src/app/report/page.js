'use strict';
// The page of a report. `data` is what src/app/report_page.cpp puts into it: report.json as it stands, the pictures, and
// the colours that they use.
(() => {
  const data = JSON.parse(document.getElementById('data').textContent);
  const { report, pictures } = data;
  const { job, totals } = report;
  const byId = (id) => document.getElementById(id);
  const statistics = new Map(report.frames.map((frame) => [frame.index, frame]));
  const pictureOf = new Map(pictures.frames.map((frame) => [frame.index, frame]));
  const keyframes = report.frames.filter((frame) => frame.kind === 'keyframe').map((frame) => frame.index);
  const samplesPerFrame = job.size[0] * job.size[1] * job.supersample * job.supersample;

  // Numbers as people read them. The exact value is kept beside them (data-value), so that nothing is lost.
  const whole = (value) => value.toLocaleString('en');
  const percent = (value) => `${value.toFixed(value !== 0 && Math.abs(value) < 10 ? 2 : 1)} %`;
  const duration = (seconds) => {
    if (seconds < 60) return `${seconds.toFixed(seconds < 10 ? 2 : 1)} s`;
    if (seconds < 3600) return `${Math.floor(seconds / 60)} min ${Math.round(seconds % 60)} s`;
    return `${Math.floor(seconds / 3600)} h ${Math.round((seconds % 3600) / 60)} min`;
  };
  const bytes = (value) => (value >= 1e9 ? `${(value / 1e9).toFixed(2)} GB` : `${(value / 1e6).toFixed(0)} MB`);

  function element(name, text, attributes = {}) {
    const made = document.createElement(name);
    if (text !== undefined) made.textContent = text;
    for (const [key, value] of Object.entries(attributes)) made.setAttribute(key, value);
    return made;
  }
  function fact(list, name, text, key, value, kind) {
    const box = element('div', undefined, kind ? { class: kind } : {});
    const shown = element('dd', text);
    if (key) {
      shown.dataset.key = key;
      shown.dataset.value = value;
    }
    box.append(element('dt', name), shown);
    list.append(box);
  }
  function fillTable(table, heads, rows) {
    if (heads) {
      const row = element('tr');
      for (const head of heads) row.append(element('th', head, { scope: 'col' }));
      const head = element('thead');
      head.append(row);
      table.append(head);
    }
    const body = element('tbody');
    for (const cells of rows) {
      const row = element('tr');
      cells.forEach((cell, column) => row.append(
        heads || column > 0 ? element('td', cell) : element('th', cell, { scope: 'row' })));
      body.append(row);
    }
    table.append(body);
  }

  // ---- Totals, parts, the job ----

  const last = job.last_frame;
  byId('summary').textContent =
    `${job.path ? `${job.path}, ` : ''}${whole(job.frames)} frames of ${job.size[0]} × ${job.size[1]} at ${job.fps} a second`;
  byId('version').textContent = report.version;

  const list = byId('totals');
  const total = (name, text, key) => fact(list, name, text, key, totals[key]);
  total('Frames', whole(totals.frames), 'frames');
  total('Keyframes', whole(totals.keyframes), 'keyframes');
  total('Samples ray traced', percent(100 * totals.traced_fraction), 'traced_fraction');
  if (data.speedup) {
    fact(list, `Speedup, ${data.speedup.kind}`, `${data.speedup.value.toFixed(2)} ×`, 'speedup', data.speedup.value);
    byId('speedup-how').textContent = data.speedup.how;
  }
  total('Wall time', duration(totals.seconds_wall), 'seconds_wall');
  total('Largest memory', bytes(totals.peak_rss_bytes), 'peak_rss_bytes');
  total('Samples', whole(totals.samples), 'samples');
  total('Samples shaded', whole(totals.samples_traced), 'samples_traced');
  total('Rays', whole(totals.rays), 'rays');
  total('Visibility rays', whole(totals.visibility_rays), 'visibility_rays');
  if (data.comparison) {
    fact(list, 'Visible difference, mean', percent(data.comparison.percent_visible_mean), 'percent_visible_mean',
      data.comparison.percent_visible_mean);
    fact(list, `… of the worst frame (${data.comparison.worst_frame})`, percent(data.comparison.percent_visible_worst),
      'percent_visible_worst', data.comparison.percent_visible_worst);
  }

  const parts = Object.entries(totals.seconds);
  fillTable(byId('parts-table'), ['Part', 'Seconds', 'Of the wall time'], parts.map(([name, seconds]) => [
    name, seconds.toFixed(2), percent(totals.seconds_wall > 0 ? 100 * seconds / totals.seconds_wall : 0)]));

  if (job.command) {
    byId('command').textContent = job.command;
    if (job.directory) byId('repeat-where').textContent = `, in ${job.directory}`;
    byId('copy').addEventListener('click', async () => {
      try {
        await navigator.clipboard.writeText(job.command);
        byId('copy').textContent = 'Copied';
      } catch {
        getSelection().selectAllChildren(byId('command'));
      }
    });
  } else {
    byId('repeat').hidden = true;
  }
  function asText(value) {
    if (Array.isArray(value)) return value.join(' × ');
    if (value === null || typeof value !== 'object') return String(value);
    return Object.entries(value).map(([key, part]) => `${key} ${asText(part)}`).join(', ');
  }
  const asked = Object.entries(job).filter(([key]) => key !== 'command' && key !== 'directory');
  byId('job-table').className = 'text';
  fillTable(byId('job-table'), null, asked.map(([key, value]) => [key.replaceAll('_', ' '), asText(value)]));
  byId('json').textContent = JSON.stringify(report, null, 2);

  const compared = data.pictures.frames.some((frame) => frame.percent_visible !== undefined);
  fillTable(byId('frames-table'),
    ['Frame', 'Kind', 'Samples traced', 'Holes', 'Of items', 'Warped', 'Seconds'].concat(compared ? ['Visibly different'] : []),
    report.frames.map((f) => [f.index, f.kind, whole(f.samples_traced), whole(f.holes), whole(f.items_traced), whole(f.warped),
      f.seconds.toFixed(2)].concat(compared ? [visibleText(f.index)] : [])));
  fillTable(byId('segments-table'),
    ['Frames', 'Middle', 'Depth', 'Visibly different', 'Masked', 'Not verified', 'Decision'],
    report.segments.map((s) => [`${s.first}–${s.last}`, s.middle, s.depth, percent(s.difference_percent), percent(s.masked_percent),
      percent(s.unverified_percent ?? 0), s.decision]));

  function visibleText(index) {
    const value = pictureOf.get(index)?.percent_visible;
    return value === undefined ? '' : percent(value);
  }

  // ---- The walk ----

  const scrubber = byId('scrubber');
  scrubber.min = job.first_frame;
  scrubber.max = last;
  let current = job.first_frame;
  const listeners = [];

  const kinds = {
    result: 'Result', source: 'Source map', metric: 'Metric map', reference: 'Reference',
  };
  const available = Object.keys(kinds).filter((kind) => pictures.frames.some((frame) => frame[kind]));

  function describe(kind, index) {
    const f = statistics.get(index);
    const share = f ? percent(100 * f.samples_traced / samplesPerFrame) : '';
    switch (kind) {
      case 'result': return `Frame ${index} as rendered${f ? `, ${f.kind}` : ''}`;
      case 'source': return `Where the pixels of frame ${index} come from${f ? `: ${share} ray traced` : ''}`;
      case 'metric': {
        if (compared) return `Where a viewer sees a difference to the reference: ${visibleText(index)} of frame ${index}`;
        const judged = judgedAt(index);
        if (!judged) return `Frame ${index} was not judged`;
        return `Where a viewer sees a difference between the two keyframes warped to frame ${index}: `
          + `${percent(judged.difference_percent)} of what was not masked`;
      }
      default: return `Frame ${index} of the reference, every sample ray traced`;
    }
  }
  function judgedAt(index) {
    return report.segments.filter((s) => s.middle === index).at(-1);
  }
  function segmentAt(index) {
    // The deepest, which is the one that decided.
    return report.segments.filter((s) => s.first <= index && index <= s.last).sort((a, b) => b.depth - a.depth)[0];
  }
  function showPicture(place, kind) {
    const image = byId(`picture-${place}`);
    const source = pictureOf.get(current)?.[kind];
    const text = source ? describe(kind, current) : `${kinds[kind]}: there is none of frame ${current}`;
    if (source) image.src = source;
    else image.removeAttribute('src');
    image.alt = text;
    byId(`caption-${place}`).textContent = text;
  }
  function showFacts() {
    const facts = byId('frame-facts');
    facts.replaceChildren();
    fact(facts, 'Frame', `${current}`, 'current', current);
    fact(facts, 'Time', `${(current / job.fps).toFixed(2)} s`);
    const f = statistics.get(current);
    if (f) {
      fact(facts, 'Kind', f.kind);
      fact(facts, 'Ray traced', percent(100 * f.samples_traced / samplesPerFrame), 'frame.samples_traced', f.samples_traced);
      fact(facts, 'Holes', percent(100 * f.holes / samplesPerFrame), 'frame.holes', f.holes);
      fact(facts, 'Items traced', percent(100 * f.items_traced / samplesPerFrame), 'frame.items_traced', f.items_traced);
      fact(facts, 'Work', duration(f.seconds), 'frame.seconds', f.seconds);
    }
    if (visibleText(current)) fact(facts, 'Visibly different', visibleText(current));
    const segment = segmentAt(current);
    if (segment) {
      fact(facts, 'Segment', `Frames ${segment.first} to ${segment.last}: ${segment.decision === 'accept' ? 'accepted' : 'split'}, `
        + `${percent(segment.difference_percent)} visibly different in frame ${segment.middle}, `
        + `${percent(segment.masked_percent)} ray traced anyway`,
      undefined, undefined, 'long');
    }
  }
  function show(index) {
    current = Math.min(Math.max(Math.round(index), job.first_frame), last);
    scrubber.value = current;
    scrubber.setAttribute('aria-valuetext', `Frame ${current} of ${job.first_frame} to ${last}`);
    byId('frame-number').textContent = `${current} / ${last}`;
    if (available.length > 0) {
      showPicture('first', byId('first').value);
      showPicture('second', byId('second').value);
    }
    showFacts();
    for (const listener of listeners) listener();
  }
  function showLegend() {
    const chosen = [byId('first').value, byId('second').value];
    const legend = byId('legend');
    legend.replaceChildren();
    const entries = (chosen.includes('source') ? data.sources : []).concat(chosen.includes('metric') ? data.visibility : []);
    for (const { name, colour } of entries) {
      const entry = element('span');
      const patch = element('i');
      patch.style.background = colour;
      entry.append(patch, name);
      legend.append(entry);
    }
  }

  if (available.length === 0) {
    byId('no-pictures').hidden = false;
    byId('viewer').hidden = true;
  }
  for (const [id, wanted] of [['first', 'result'], ['second', available.includes('reference') ? 'reference' : 'source']]) {
    for (const kind of available) byId(id).append(element('option', kinds[kind], { value: kind }));
    byId(id).value = available.includes(wanted) ? wanted : available[0];
    byId(id).addEventListener('change', () => { showLegend(); show(current); });
  }
  for (const choice of document.querySelectorAll('input[name=layout]')) {
    choice.addEventListener('change', () => {
      byId('stage').className = choice.value;
      byId('wipe-label').hidden = choice.value !== 'wipe';
    });
  }
  byId('wipe').addEventListener('input', () => byId('stage').style.setProperty('--wipe', `${byId('wipe').value}%`));
  scrubber.addEventListener('input', () => show(Number(scrubber.value)));

  let playing = null;
  function play(on) {
    playing = on ? { since: performance.now(), from: current >= last ? job.first_frame : current } : null;
    byId('play').textContent = on ? 'Pause' : 'Play';
    byId('play').setAttribute('aria-pressed', String(on));
    if (on) requestAnimationFrame(step);
  }
  function step(now) {
    if (!playing) return;
    const index = playing.from + Math.floor(Math.max(now - playing.since, 0) / 1000 * job.fps);
    if (index !== current) show(index);
    if (index >= last) play(false);
    else requestAnimationFrame(step);
  }
  const go = (index) => { play(false); if (index !== undefined) show(index); };
  const previousKeyframe = () => go(keyframes.findLast((index) => index < current));
  const nextKeyframe = () => go(keyframes.find((index) => index > current));
  byId('play').addEventListener('click', () => play(!playing));
  byId('previous-key').addEventListener('click', previousKeyframe);
  byId('next-key').addEventListener('click', nextKeyframe);
  document.addEventListener('keydown', (event) => {
    if (event.ctrlKey || event.altKey || event.metaKey) return;
    const inControl = event.target.closest('input, select, button, summary, textarea');
    if (inControl && event.target !== scrubber) return;
    const actions = {
      ArrowLeft: () => go(current - 1), ArrowRight: () => go(current + 1), ' ': () => play(!playing),
      PageUp: previousKeyframe, PageDown: nextKeyframe, Home: () => go(job.first_frame), End: () => go(last),
    };
    // Outside the scrubber the keys that scroll a page keep doing so.
    const wanted = event.target === scrubber ? actions[event.key] : event.key.startsWith('Arrow') && actions[event.key];
    if (!wanted) return;
    event.preventDefault();
    wanted();
  });

  // ---- Charts (Chart.js) ----

  const style = (name) => getComputedStyle(document.documentElement).getPropertyValue(name).trim();
  Chart.defaults.animation = false;
  Chart.defaults.maintainAspectRatio = false;
  Chart.defaults.font.family = 'system-ui, sans-serif';

  // A line at the frame that is shown.
  const cursor = {
    id: 'cursor',
    afterDatasetsDraw(chart) {
      const { ctx, chartArea, scales } = chart;
      const x = scales.x.getPixelForValue(current);
      ctx.save();
      ctx.strokeStyle = style('--text');
      ctx.beginPath();
      ctx.moveTo(x, chartArea.top);
      ctx.lineTo(x, chartArea.bottom);
      ctx.stroke();
      ctx.restore();
    },
  };
  const frameScale = () => ({
    type: 'linear', min: job.first_frame - 0.5, max: last + 0.5, offset: false, stacked: true, grid: { display: false },
    // Numbers of frames, never halves of one.
    afterBuildTicks: (scale) => { scale.ticks = scale.ticks.filter(({ value }) => Number.isInteger(value)); },
  });
  // One width of the axis on the left, so that the charts' frames stand below one another.
  const valueScale = (title, more = {}) => ({
    beginAtZero: true, title: { display: true, text: title }, afterFit: (scale) => { scale.width = 62; }, ...more,
  });
  function frameChart(id, datasets, y, titleOf = (items) => `Frame ${items[0].raw.x}`) {
    const chart = new Chart(byId(id), {
      type: 'bar',
      data: { datasets: datasets.map((set) => ({ barPercentage: 1, categoryPercentage: 1, ...set })) },
      options: {
        interaction: { mode: 'index', axis: 'x', intersect: false },
        scales: { x: frameScale(), y },
        onClick: (event, _, clicked) => go(clicked.scales.x.getValueForPixel(event.x)),
        plugins: { legend: { display: datasets.length > 1 }, tooltip: { callbacks: { title: titleOf } } },
      },
      plugins: [cursor],
    });
    listeners.push(() => chart.draw());
    return chart;
  }
  const colourOf = (name) => data.sources.find((source) => source.key === name).colour;
  const shares = (value) => report.frames.map((f) => ({ x: f.index, y: 100 * value(f) / samplesPerFrame }));
  const charts = [
    frameChart('frames-chart', [
      { label: 'keyframe', backgroundColor: colourOf('traced'),
        data: shares((f) => (f.kind === 'keyframe' ? f.samples_traced : 0)) },
      { label: 'holes', backgroundColor: colourOf('hole'), data: shares((f) => f.holes) },
      { label: 'items', backgroundColor: colourOf('item'), data: shares((f) => f.items_traced) },
      { label: 'warped', backgroundColor: colourOf('blended'), data: shares((f) => f.warped) },
    ], valueScale('samples, %', { stacked: true, max: 100 })),
    frameChart('seconds-chart', [{ label: 'seconds', backgroundColor: colourOf('previous'),
      data: report.frames.map((f) => ({ x: f.index, y: f.seconds })) }], valueScale('seconds')),
  ];
  if (compared) {
    byId('visible-block').hidden = false;
    charts.push(frameChart('visible-chart', [{ label: 'visibly different, %', backgroundColor: colourOf('hole'),
      data: pictures.frames.filter((f) => f.percent_visible !== undefined).map((f) => ({ x: f.index, y: f.percent_visible })) }],
    valueScale('pixels, %')));
  }
  if (report.segments.length > 0) {
    const depths = Math.max(...report.segments.map((s) => s.depth)) + 1;
    byId('segments-box').style.height = `${4.5 + 2 * depths}rem`;
    const bars = (decision) => report.segments.filter((s) => s.decision === decision)
      .map((s) => ({ x: [s.first, s.last], y: `depth ${s.depth}`, segment: s }));
    const segmentSet = (label, decision, colour) => ({
      label, data: bars(decision), backgroundColor: colourOf(colour), grouped: false, borderSkipped: false,
      borderWidth: 1, borderColor: () => style('--ground'), barPercentage: 0.9, categoryPercentage: 1, minBarLength: 3 });
    const chart = new Chart(byId('segments-chart'), {
      type: 'bar',
      data: {
        labels: Array.from({ length: depths }, (_, depth) => `depth ${depth}`),
        datasets: [segmentSet('accepted', 'accept', 'blended'), segmentSet('split', 'split', 'hole')],
      },
      options: {
        indexAxis: 'y',
        scales: {
          x: { ...frameScale(), stacked: false },
          y: { afterFit: (scale) => { scale.width = 62; }, grid: { display: false } },
        },
        onClick: (event, _, clicked) => go(clicked.scales.x.getValueForPixel(event.x)),
        plugins: { tooltip: { callbacks: {
          title: (items) => `Frames ${items[0].raw.segment.first} to ${items[0].raw.segment.last}`,
          label: ({ raw: { segment: s } }) =>
            `${s.decision}: ${percent(s.difference_percent)} visibly different in frame ${s.middle}`,
          afterLabel: ({ raw: { segment: s } }) =>
            `${percent(s.masked_percent)} masked, ${percent(s.unverified_percent ?? 0)} not verified`,
        } } },
      },
      plugins: [cursor],
    });
    listeners.push(() => chart.draw());
    charts.push(chart);
  } else {
    byId('segments-block').hidden = true;
  }
  byId('parts-box').style.height = `${3 + 1.6 * parts.length}rem`;
  charts.push(new Chart(byId('parts-chart'), {
    type: 'bar',
    data: { labels: parts.map(([name]) => name),
      datasets: [{ label: 'seconds', data: parts.map(([, seconds]) => seconds), backgroundColor: colourOf('previous') }] },
    options: { indexAxis: 'y', plugins: { legend: { display: false } },
      scales: { x: { title: { display: true, text: 'seconds' } }, y: { grid: { display: false } } } },
  }));

  function dress() {
    for (const chart of charts) {
      chart.options.color = style('--text');
      for (const scale of Object.values(chart.options.scales)) {
        scale.ticks = { ...scale.ticks, color: style('--text') };
        if (scale.title) scale.title.color = style('--quiet');
        scale.grid = { ...scale.grid, color: style('--line') };
      }
      chart.update();
    }
  }
  matchMedia('(prefers-color-scheme: dark)').addEventListener('change', dress);
  dress();
  showLegend();
  show(job.first_frame);
})();
