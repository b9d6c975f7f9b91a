-- page.lua - which page is being made: what make-notes.sh put into the environment, and the words of its language.

local env = function(name) return os.getenv('NOTES_' .. name) or '' end
local language = env 'LANGUAGE'

-- The words that the build puts into a page.
local words = ({
  en = {
    exercise = 'Exercise', answer = 'Answer', difference = 'Difference', command = 'Compare them yourself',
    largest = 'Largest difference', flip = 'FLIP', rmse = 'RMSE', identical = 'Identical pixels', equal = 'no pixel differs',
    agree = 'within the scene’s limits', differ = 'beyond the scene’s limits', slider = 'Slider between %s and %s',
    differenceAlt = 'Where the two differ, in false colours; the largest difference is %s.',
    copy = 'Copy', copied = 'Copied', output = 'prints', line = 'line', contents = 'On this page', chapters = 'Chapters',
    previous = 'Previous', next = 'Next', skip = 'Skip to the text', dark = 'Dark', notes = 'The notes',
    languages = 'Language', colon = ': ', chapter = 'Chapter', runs = 'Run', from = 'from', to = 'to',
    footer = 'Made by make notes: every picture and every number on this page came from the commands beside it. It needs no network.',
  },
  fr = {
    exercise = 'Exercice', answer = 'Réponse', difference = 'Différence', command = 'Comparez vous-même',
    largest = 'Plus grande différence', flip = 'FLIP', rmse = 'RMSE', identical = 'Pixels identiques', equal = 'aucun pixel ne diffère',
    agree = 'dans les limites de la scène', differ = 'hors des limites de la scène', slider = 'Curseur entre %s et %s',
    differenceAlt = 'Là où les deux diffèrent, en fausses couleurs\u{202F}; la plus grande différence est %s.',
    copy = 'Copier', copied = 'Copié', output = 'affiche', line = 'ligne', contents = 'Sur cette page', chapters = 'Chapitres',
    previous = 'Précédent', next = 'Suivant', skip = 'Aller au texte', dark = 'Sombre', notes = 'Les notes de cours',
    languages = 'Langue', colon = '\u{A0}: ', chapter = 'Chapitre', runs = 'Commandes', from = 'de', to = 'à',
    footer = 'Page faite par make notes\u{A0}: chacune de ses images et chacun de ses nombres viennent des commandes placées à côté. Elle n’a pas besoin du réseau.',
  },
})[language]

return {
  env = env,
  language = language,
  name = env 'NAME',
  work = env 'WORK', -- the folder in which commands run
  leads = env 'LEADS' == 'yes', -- whether this language runs the commands
  words = words,
}
