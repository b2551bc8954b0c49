/** What the menu of files gives. */

/** The text of the picture that a view offers by this name as SVG. */
export async function svgOf(page, name) {
  await page.click("#export-button");
  const item = page.locator(".menu .items button", { hasText: name }).filter({ hasText: "SVG" });
  const [download] = await Promise.all([page.waitForEvent("download"), item.click()]);
  const chunks = [];
  for await (const chunk of await download.createReadStream()) chunks.push(chunk);
  return String(Buffer.concat(chunks));
}
