/* explain_page.js - the sliders between two pictures, and light or dark; without it the pictures lie side by
 * side. */
'use strict';

for (const pair of document.querySelectorAll('.pair')) {
  const slider = pair.querySelector('input');
  const show = () => pair.style.setProperty('--split', `${slider.value}%`);
  slider.addEventListener('input', show);
  show();
  const follow = (event) => {
    const frame = pair.getBoundingClientRect();
    slider.value = Math.min(100, Math.max(0, ((event.clientX - frame.left) / frame.width) * 100));
    show();
  };
  for (const figure of pair.querySelectorAll('figure')) {
    figure.addEventListener('pointerdown', follow);
    figure.addEventListener('pointermove', (event) => { if (event.buttons & 1) follow(event); });
    figure.addEventListener('dragstart', (event) => event.preventDefault());
  }
}

const themeButton = document.getElementById('theme-button');
const root = document.documentElement;
const isDark = () => (root.dataset.theme || (matchMedia('(prefers-color-scheme: dark)').matches ? 'dark' : 'light')) === 'dark';
themeButton.setAttribute('aria-pressed', isDark());
themeButton.addEventListener('click', () => {
  root.dataset.theme = isDark() ? 'light' : 'dark';
  themeButton.setAttribute('aria-pressed', isDark());
  try { localStorage.setItem('eclairage-theme', root.dataset.theme); } catch { /* no storage */ }
});
