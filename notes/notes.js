/* notes.js - what a page of the notes does beyond being read: sliders, light and dark, copying, print.
 * Without it every picture, formula, number and answer is there too. */
'use strict';
const byId = (id) => document.getElementById(id);

/* A slider: the second picture lies on the first and is cut at the slider. The pictures can be dragged over
 * as well; the range is what the keyboard and a screen reader use. */
for (const wiper of document.querySelectorAll('.wiper')) {
  const stage = wiper.querySelector('.stage'), range = wiper.querySelector('input');
  const [first, second] = [...stage.querySelectorAll('.label')].map((label) => label.textContent);
  const show = () => {
    stage.style.setProperty('--split', `${range.value}%`);
    range.setAttribute('aria-valuetext', `${first} ${range.value} %, ${second} ${100 - range.value} %`);
  };
  const follow = (event) => {
    const frame = stage.getBoundingClientRect();
    range.value = Math.round((100 * (event.clientX - frame.left)) / frame.width);
    show();
  };
  range.addEventListener('input', show);
  stage.addEventListener('pointerdown', (event) => {
    if (event.button !== 0) return;
    if (event.pointerType === 'mouse') event.preventDefault();
    stage.setPointerCapture(event.pointerId);
    follow(event);
  });
  stage.addEventListener('pointermove', (event) => { if (stage.hasPointerCapture(event.pointerId)) follow(event); });
  wiper.classList.add('live');
  show();
}

/* Light and dark: the system's choice until the reader makes one. */
const systemDark = matchMedia('(prefers-color-scheme: dark)');
const isDark = () => (document.documentElement.dataset.theme || (systemDark.matches ? 'dark' : 'light')) === 'dark';
const showTheme = () => byId('theme-button').setAttribute('aria-pressed', String(isDark()));
byId('theme-button').addEventListener('click', () => {
  document.documentElement.dataset.theme = isDark() ? 'light' : 'dark';
  try { localStorage.setItem('eclairage-theme', document.documentElement.dataset.theme); } catch { /* it lasts as long as the page */ }
  showTheme();
});
systemDark.addEventListener('change', showTheme);
showTheme();

/* Copy commands; without clipboard access, select them so that the reader can. */
for (const button of document.querySelectorAll('.copy')) {
  const said = button.textContent;
  button.addEventListener('click', async () => {
    const code = button.parentElement.querySelector('code');
    let copied = true;
    try { await navigator.clipboard.writeText(code.textContent.trim()); } catch {
      const range = document.createRange();
      range.selectNodeContents(code);
      getSelection().removeAllRanges();
      getSelection().addRange(range);
      copied = document.execCommand('copy');
    }
    if (!copied) return;
    button.textContent = byId('announce').dataset.copied;
    byId('announce').textContent = button.textContent;
    setTimeout(() => { button.textContent = said; byId('announce').textContent = ''; }, 1500);
  });
}

/* What scrolls sideways can be reached with the keyboard. */
for (const box of document.querySelectorAll('pre, .formula, .long-formula, .scroll')) {
  if (box.scrollWidth > box.clientWidth) box.tabIndex = 0;
  else box.removeAttribute('tabindex');
}

/* The list of chapters closes when one looks elsewhere. */
const menu = document.querySelector('.menu');
document.addEventListener('click', (event) => { if (!menu.contains(event.target)) menu.open = false; });
document.addEventListener('keydown', (event) => {
  if (event.key !== 'Escape' || !menu.open) return;
  menu.open = false;
  menu.querySelector('summary').focus();
});

/* The contents lie open beside the text, and closed above it where there is no room. Print opens answers. */
const contents = document.querySelector('.contents details');
const wide = matchMedia('(min-width: 1100px)');
const placeContents = () => { if (contents) contents.open = wide.matches; };
wide.addEventListener('change', placeContents);
placeContents();

const answers = [...document.querySelectorAll('.answer')];
let openedForPrint = [];
function openAnswers() {
  openedForPrint.push(...answers.filter((answer) => !answer.open));
  for (const answer of openedForPrint) answer.open = true;
}
function closeAnswers() {
  for (const answer of openedForPrint) answer.open = false;
  openedForPrint = [];
}
addEventListener('beforeprint', openAnswers);
addEventListener('afterprint', closeAnswers);
matchMedia('print').addEventListener('change', (event) => (event.matches ? openAnswers() : closeAnswers()));

/* Mark in the contents the section that is being read. */
const entries = new Map([...document.querySelectorAll('.contents a')].map((a) => [decodeURIComponent(a.hash.slice(1)), a]));
const headings = [...document.querySelectorAll('main :is(h2, h3)[id]')].filter((h) => entries.has(h.id));
function markSection() {
  let current = null;
  for (const heading of headings) if (heading.getBoundingClientRect().top < innerHeight * 0.3) current = heading;
  for (const [id, a] of entries) a.toggleAttribute('data-current', Boolean(current && id === current.id));
}
addEventListener('scroll', markSection, { passive: true });
markSection();
