-- A page of the documents: its first heading is its title, and links to Markdown lead to its page.
local title

function Header(header)
  if header.level == 1 and not title then
    title = header.content
    return {}
  end
end

-- Links to targets that are not pages (sources, folders) become plain text.
function Link(link)
  if link.target:match("^%a+:") or link.target:match("^#") then
    return link
  end
  if not link.target:match("%.md") then
    return link.content
  end
  link.target = link.target:gsub("%.md$", ".html"):gsub("%.md#", ".html#")
  return link
end

function Meta(meta)
  meta.title = meta.title or title
  return meta
end

-- The heading has to be read before the title is set.
return { { Header = Header, Link = Link }, { Meta = Meta } }
